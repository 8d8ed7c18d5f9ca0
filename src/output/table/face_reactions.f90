!> Reactions of each supported face
module axijoint_output_table_face_reactions
   use axijoint_analysis_core_results, only : results_type, n_resultants
   use axijoint_analysis_core_rigid, only : rigid_resultants
   use axijoint_base_kinds, only : wp
   use axijoint_model_model, only : model_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_face_reactions, write_support_group

   !> Number of a face
   character(len=*), parameter :: format_face = '(i14)'
   !> Columns of the resultants
   integer, parameter :: wide = 15

contains

   !> Resultants of the reactions of the supported faces, moments about the origin.
   !> A node of several faces counts with the first, so that the sum is that of all
   pure function resultants_of_faces(model, results) result(resultant)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> The resultants, shape (n_resultants, faces)
      real(wp) :: resultant(n_resultants, size(model%supported_faces))

      integer :: k

      do k = 1, size(model%supported_faces)
         resultant(:, k) = resultants_of_nodes(model, results, model%supported_faces(k)%nodes)
      end do
   end function resultants_of_faces

   !> Resultants of the reactions of some nodes
   pure function resultants_of_nodes(model, results, nodes) result(resultant)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
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
   end function resultants_of_nodes

   !> Nodes of no supported face
   pure function other_nodes(model) result(nodes)
      !> The job
      type(model_type), intent(in) :: model
      !> The nodes
      integer, allocatable :: nodes(:)

      logical :: other(size(model%mesh%node_label))
      integer :: k

      other = .true.
      do k = 1, size(model%supported_faces)
         other(model%supported_faces(k)%nodes) = .false.
      end do
      nodes = pack([(k, k=1, size(other))], other)
   end function other_nodes

   !> Table of the supported faces, and of the other supports
   subroutine write_face_reactions(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      integer, parameter :: order(n_resultants) = [1, 2, 5, 3, 6, 4]  ! as on cuts
      real(wp) :: resultant(n_resultants, size(model%supported_faces)), others(n_resultants)
      character(len=14) :: label
      integer :: k

      if (size(model%supported_faces) == 0) return
      resultant = resultants_of_faces(model, results)
      others = resultants_of_nodes(model, results, other_nodes(model))
      call write_result_heading(file, "REACTIONS OF SUPPORTED FACES (moments about the origin)", &
         results%converged)
      call file%put("          face    axial force     force at 0    force at 90    moment at 0"// &
         "   moment at 90         torque")
      do k = 1, size(model%supported_faces)
         write (label, format_face) model%supported_faces(k)%label
         call file%put(label//columns(resultant(order, k), wide))
      end do
      call file%put("  other nodes "//columns(others(order), wide))
      call file%put("  together    "//columns(results%reacted(order), wide))
   end subroutine write_face_reactions

   !> The same in the HDF5 file
   subroutine write_support_group(file, model, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      if (size(model%supported_faces) == 0) return
      call file%group("/supports")
      call file%write("/supports/face", (model%supported_faces%label), "Number in the deck; (face)")
      call file%write("/supports/reacted", resultants_of_faces(model, results), &
         "Axial force, lateral force, moment, torque, lateral force and moment at 90 degrees "// &
         "of the "// &
         "reactions; (6, face)")
   end subroutine write_support_group

end module axijoint_output_table_face_reactions
