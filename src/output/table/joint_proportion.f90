!> Stiffness of the joints beside the bodies, k h/E: in the listing, the summary, on the terminal
module axijoint_output_table_joint_proportion
   use axijoint_analysis_core_proportion_remarks, only : stiffer_text
   use axijoint_analysis_core_results, only : results_type, stiffer_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_model_joint_proportion, only : proportion_type, joint_proportions, side_of, &
      side_soft, side_stiff
   use axijoint_model_model, only : model_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_headings, only : write_heading
   use axijoint_output_file_json, only : json_number
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_proportions, write_proportion_arrays, proportions_json, proportions_text, &
      stiffer_laws_text

   !> Words for a side of what is sensible
   character(len=*), parameter :: side_names(-1:1) = &
      [character(len=8) :: 'soft', 'sensible', 'stiff']
   !> Directions of a joint
   character(len=*), parameter :: directions(3) = [character(len=5) :: 'xi', 'eta', 'theta']
   !> Number of a law, and of its joints
   character(len=*), parameter :: format_law = '(2i10)'
   !> Columns of reals
   integer, parameter :: wide = 15
   !> More laws than these are shown together on the terminal
   integer, parameter :: most_laws = 4

contains

   !> Table of the listing: all laws that have joints
   subroutine write_proportions(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      type(proportion_type), allocatable :: proportions(:)
      character(len=20) :: numbers
      integer :: i, k

      proportions = joint_proportions(model)
      if (all(proportions%n_joints == 0)) return
      call write_heading(file, "STIFFNESS OF THE JOINTS BESIDE THE BODIES (k h/E, the least "// &
         "and the largest)")
      call file%put("       law    joints      xi, least       largest     eta, least        "// &
         "largest"// &
         "   theta, least        largest")
      do i = 1, size(proportions)
         associate (of_law => proportions(i), law => model%joint_materials(i)%law)
            if (of_law%n_joints == 0) cycle
            write (numbers, format_law) model%joint_materials(i)%label, of_law%n_joints
            call file%put(numbers//columns([(of_law%least(k), of_law%largest(k), k=1, 3)], wide)// &
               "  "// &
               trim(side_names(side_of(law, of_law))))
         end associate
      end do
   end subroutine write_proportions

   !> The same in the HDF5 file; zeros where a law has no joints
   subroutine write_proportion_arrays(file, model)
      !> The file, in which the group of the laws is
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      type(proportion_type), allocatable :: proportions(:)
      integer :: i, n

      proportions = joint_proportions(model)
      n = size(proportions)
      call file%write("/joint_materials/joints", (proportions%n_joints), "Number of joints; (law)")
      call file%write("/joint_materials/kappa_least", &
         reshape([(merge(proportions(i)%least, 0.0_wp, proportions(i)%n_joints > 0), i=1, n)], &
         [3, n]), &
         "Least k h/E of the joints along xi, eta, theta; (3, law)")
      call file%write("/joint_materials/kappa_largest", &
         reshape([(proportions(i)%largest, i=1, n)], [3, n]), &
         "Largest k h/E of the joints along xi, eta, theta; (3, law)")
   end subroutine write_proportion_arrays

   !> All laws, with what stiffer joints would change where they are out of proportion
   pure function proportions_json(model, results) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array
      character(len=:), allocatable :: json

      type(proportion_type), allocatable :: proportions(:)
      integer :: i, k

      proportions = joint_proportions(model)
      json = "["
      do i = 1, size(proportions)
         if (i > 1) json = json//", "
         associate (of_law => proportions(i))
            json = json//'{"law": '//json_number(model%joint_materials(i)%label)// &
               ', "joints": '//json_number(of_law%n_joints)
            do k = 1, 3
               json = json//', "kappa_'//trim(directions(k))//'": '
               if (of_law%n_joints > 0) then
                  json = json//'['//json_number(of_law%least(k))//', '// &
                     json_number(of_law%largest(k))//']'
               else
                  json = json//'null'
               end if
            end do
            json = json//', "side": "'//trim(side_names(side_of(model%joint_materials(i)%law, &
               of_law)))// &
               '", "ten_times": '//ten_times_json(model, results, i)//'}'
         end associate
      end do
      json = json//"]"
   end function proportions_json

   !> What would change if a law and those on its side were ten times as stiff
   pure function ten_times_json(model, results, law) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> The law (index)
      integer, intent(in) :: law
      !> A JSON object, or null
      character(len=:), allocatable :: json

      integer :: i, k

      json = "null"
      if (.not. allocated(results%stiffer)) return
      do i = 1, size(results%stiffer)
         associate (stiffer => results%stiffer(i))
            if (.not. (stiffer%known .and. any(stiffer%laws == law))) cycle
            json = '{"laws": ['
            do k = 1, size(stiffer%laws)
               if (k > 1) json = json//', '
               json = json//json_number(model%joint_materials(stiffer%laws(k))%label)
            end do
            json = json//'], "displacement": '//json_number(stiffer%displacement)// &
               ', "displacement_anywhere": '//json_number(stiffer%displacement_anywhere)// &
               ', "joint_stress": '//json_number(stiffer%joint_stress)// &
               ', "joint_stress_anywhere": '//json_number(stiffer%joint_stress_anywhere)//'}'
         end associate
      end do
   end function ten_times_json

   !> For the terminal: k h/E of each law, or of all together if there are many; empty without
   !> joints
   pure function proportions_text(model) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Words
      character(len=:), allocatable :: text

      type(proportion_type), allocatable :: proportions(:), used(:)
      integer :: i, side

      text = ""
      proportions = joint_proportions(model)
      used = pack(proportions, proportions%n_joints > 0)
      if (size(used) == 0) return
      if (size(used) > most_laws) text = range_text(used)//" ("//to_text(size(used))//" laws)"
      do i = 1, size(proportions)
         if (proportions(i)%n_joints == 0) cycle
         side = side_of(model%joint_materials(i)%law, proportions(i))
         if (size(used) > most_laws .and. side /= side_soft .and. side /= side_stiff) cycle
         if (len(text) > 0) text = text//", "
         text = text//range_text(proportions(i:i))//" (law "// &
            to_text(model%joint_materials(i)%label)
         if (side == side_soft .or. side == side_stiff) text = text//", "//trim(side_names(side))
         text = text//")"
      end do
      text = "k h/E = "//text
   end function proportions_text

   !> Least and largest k h/E of some laws, directions without stiffness left out
   pure function range_text(proportions) result(text)
      !> The laws, each with joints
      type(proportion_type), intent(in) :: proportions(:)
      !> Such as "0.0625 to 0.125"
      character(len=:), allocatable :: text

      real(wp) :: least, largest
      integer :: i

      least = huge(1.0_wp)
      largest = 0.0_wp
      do i = 1, size(proportions)
         least = min(least, minval(proportions(i)%least, mask=proportions(i)%least > 0.0_wp))
         largest = max(largest, maxval(proportions(i)%largest))
      end do
      text = to_text(largest)
      if (least < (1.0_wp - 1.0e-6_wp)*largest) text = to_text(least)//" to "//text
   end function range_text

   !> For the terminal: what stiffer joints of some laws would change
   pure function stiffer_laws_text(model, stiffer) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The laws and the changes
      type(stiffer_type), intent(in) :: stiffer
      !> Words
      character(len=:), allocatable :: text

      integer :: i

      text = merge("laws", "law ", size(stiffer%laws) > 1)
      text = trim(text)
      do i = 1, size(stiffer%laws)
         text = text//" "//to_text(model%joint_materials(stiffer%laws(i))%label)
      end do
      text = text//": "//stiffer_text(stiffer)
   end function stiffer_laws_text

end module axijoint_output_table_joint_proportion
