!> Resultants of the reactions of supported faces
module axijoint_analysis_core_face_reactions
   use axijoint_analysis_core_fields, only : fields_type, n_resultants
   use axijoint_analysis_core_rigid, only : rigid_resultants
   use axijoint_base_kinds, only : wp
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: face_reactions, reactions_of_nodes

contains

   !> Resultants of the reactions of the supported faces, moments about the origin.
   !> A node of several faces counts with the first, so that the sum is that of all
   pure function face_reactions(model, results) result(resultant)
      !> The job
      type(model_type), intent(in) :: model
      !> Results with reactions
      class(fields_type), intent(in) :: results
      !> The resultants, shape (n_resultants, faces)
      real(wp) :: resultant(n_resultants, size(model%supported_faces))

      integer :: k

      do k = 1, size(model%supported_faces)
         resultant(:, k) = reactions_of_nodes(model, results, model%supported_faces(k)%nodes)
      end do
   end function face_reactions

   !> Resultants of the reactions of some nodes
   pure function reactions_of_nodes(model, results, nodes) result(resultant)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      class(fields_type), intent(in) :: results
      !> The nodes
      integer, intent(in) :: nodes(:)
      !> The resultants
      real(wp) :: resultant(n_resultants)

      integer :: k

      resultant = 0.0_wp
      do k = 1, size(results%modes)
         resultant = resultant + rigid_resultants(model%mesh%coordinates(:, nodes), &
            results%modes(k), results%reaction(:, nodes, k))
      end do
   end function reactions_of_nodes

end module axijoint_analysis_core_face_reactions
