!> Sentences about joints that are soft or stiff out of proportion to the bodies
module axijoint_analysis_core_proportion_remarks
   use axijoint_analysis_core_results, only : results_type, remark_type, stiffer_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_element_joint_law, only : law_elastic
   use axijoint_model_joint_proportion, only : proportion_type, joint_proportions, side_of, &
      decisive_direction, &
      side_stiff
   use axijoint_model_material, only : joint_material_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: proportion_remarks, stiffer_text

contains

   !> Which laws are out of proportion, and what would change if they were ten times as stiff
   pure function proportion_remarks(model, results) result(remarks)
      !> The job
      type(model_type), intent(in) :: model
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences, each of which fits a line of the listing
      type(remark_type), allocatable :: remarks(:)

      type(proportion_type), allocatable :: proportions(:)
      character(len=:), allocatable :: text
      integer :: i, k

      allocate (remarks(0))
      proportions = joint_proportions(model)
      do i = 1, size(results%stiffer)
         associate (stiffer => results%stiffer(i))
            do k = 1, size(stiffer%laws)
               text = proportion_text(model%joint_materials(stiffer%laws(k)), &
                  proportions(stiffer%laws(k)))
               remarks = [remarks, remark_type(text)]
            end do
            if (.not. stiffer%known) cycle
            text = 'if ten times as stiff: '//stiffer_text(stiffer)
            remarks = [remarks, remark_type(text)]
            remarks(size(remarks))%said_elsewhere = .true.
         end associate
      end do
   end function proportion_remarks

   !> A law out of proportion in words
   pure function proportion_text(material, proportion) result(text)
      !> The law
      type(joint_material_type), intent(in) :: material
      !> Its joints
      type(proportion_type), intent(in) :: proportion
      !> The sentence
      character(len=:), allocatable :: text

      character(len=*), parameter :: directions(3) = [character(len=5) :: 'xi', 'eta', 'theta']
      !> k h/E from which on joints are as good as rigid for displacements
      real(wp), parameter :: as_rigid = 10.0_wp
      character(len=:), allocatable :: range
      integer :: direction
      logical :: stiff, in_part

      direction = decisive_direction(material%law, proportion)
      stiff = side_of(material%law, proportion) == side_stiff
      in_part = stiff .and. proportion%least(direction) < as_rigid  ! along stiffer ground, or shorter joints
      range = ', k h/E up to '//to_text(proportion%largest(direction))
      if (in_part) range = ' in part, k h/E '//to_text(proportion%least(direction))//' to '// &
         to_text(proportion%largest(direction))
      text = 'law '//to_text(material%label)//': joints '//trim(merge('stiff', 'soft ', stiff))//' out of proportion'//range// &
         ' along '//trim(directions(direction))//' (sensible: 1E-3 to 1E2)'
      if (stiff .and. material%law%kind /= law_elastic .and. proportion%largest(direction) > material%rigid) then
         text = text//trim(merge('; there counts', '; counts      ', in_part))//' as rigid, k = '//to_text(material%rigid)//' E/h'
      else if (stiff .and. .not. in_part) then
         text = text//'; k = 10 E/h is as good as rigid'
      end if
      if (in_part) then
         text = text//'; those below 10 are not as good as rigid'
      else if (.not. stiff) then
         text = text//'; contact needs about k = E/h'
      end if
   end function proportion_text

   !> What stiffer joints would change
   pure function stiffer_text(stiffer) result(text)
      !> The changes
      type(stiffer_type), intent(in) :: stiffer
      !> Words
      character(len=:), allocatable :: text

      text = 'largest displacement '//signed_percent(stiffer%displacement)//' (anywhere up to '// &
         percent(stiffer%displacement_anywhere)//'), largest joint stress '// &
         signed_percent(stiffer%joint_stress)// &
         ' (up to '//percent(stiffer%joint_stress_anywhere)//')'
   end function stiffer_text

   !> A relative change in per cent, with its sign
   pure function signed_percent(change) result(text)
      !> The change
      real(wp), intent(in) :: change
      !> Such as '+12.3 %'
      character(len=:), allocatable :: text

      text = merge('+', '-', change >= 0.0_wp)//percent(abs(change))
   end function signed_percent

   !> A size in per cent, three digits
   pure function percent(value) result(text)
      !> The size, not negative
      real(wp), intent(in) :: value
      !> Such as '12.3 %'
      character(len=:), allocatable :: text

      character(len=12) :: number

      if (value < 9.995e-2_wp) then
         write (number, '(f12.2)') 100.0_wp*value
      else if (value < 1.0e4_wp) then
         write (number, '(f12.1)') 100.0_wp*value
      else
         write (number, '(es12.2)') 100.0_wp*value
      end if
      text = trim(adjustl(number))//' %'
      if (text(1:1) == '.') text = '0'//text
   end function percent

end module axijoint_analysis_core_proportion_remarks
