!> Reactions of each supported face
module axijoint_output_table_face_reactions
   use axijoint_analysis_core_face_reactions, only : reactions_of_nodes
   use axijoint_analysis_core_fields, only : n_resultants
   use axijoint_analysis_core_results, only : results_type
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
      real(wp) :: others(n_resultants)
      character(len=14) :: label
      integer :: k

      if (size(model%supported_faces) == 0) return
      others = reactions_of_nodes(model, results, other_nodes(model))
      call write_result_heading(file, "REACTIONS OF SUPPORTED FACES (moments about the origin)", &
         results%converged)
      call file%put("          face    axial force     force at 0    force at 90    moment at 0"// &
         "   moment at 90         torque")
      do k = 1, size(model%supported_faces)
         write (label, format_face) model%supported_faces(k)%label
         call file%put(label//columns(results%face_reactions(order, k), wide))
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
      call file%write("/supports/reacted", results%face_reactions, &
         "Axial force, lateral force, moment, torque, lateral force and moment at 90 degrees "// &
         "of the "// &
         "reactions; (6, face)")
   end subroutine write_support_group

end module axijoint_output_table_face_reactions
