!> What a run did not model, and why that is exact; and what HARMONICS left out that is missing
module axijoint_analysis_core_left_out
   use axijoint_analysis_core_results, only : remark_type, results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_text, only : to_text
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric, is_torsion
   use axijoint_joints_planes, only : planes_type, new_planes
   use axijoint_model_model, only : model_type, can_yield_at, bodies_yield
   use axijoint_model_modes, only : greatest_divisor
   implicit none
   private
   public :: what_was_left_out, excited_in_vain

contains

   !> Sentences about harmonics, families, components, planes and joints that were
   !> left out because they are zero, or like others
   function what_was_left_out(model, structure) result(sentences)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> The sentences
      type(remark_type), allocatable :: sentences(:)

      type(planes_type) :: planes
      logical :: yields, coupled
      integer :: n_elastic, n_harmonics

      allocate (sentences(0))
      yields = size(structure%yielding) > 0
      coupled = yields .or. bodies_yield(model)
      associate (modes => structure%modes)
         n_harmonics = count_unused(model%harmonics, modes)
         if (n_harmonics > 0 .and. .not. coupled) then
            call add(sentences, to_text(n_harmonics)//' harmonics of '// &
               to_text(size(model%harmonics))// &
                     ': they are not loaded, and no joint that opens or slips couples them')
         else if (n_harmonics > 0 .and. all(modes%harmonic == 0)) then
            call add(sentences, to_text(n_harmonics)//' harmonics of '// &
               to_text(size(model%harmonics))// &
                     ': all is the same round the circle')
         else if (n_harmonics > 0 .and. .not. repeats((modes%harmonic))) then
            call add(sentences, to_text(n_harmonics)//' harmonics of '// &
               to_text(size(model%harmonics))// &
                     ': loads of odd harmonics alone meet criteria that are the same for a '// &
                     'stress and its opposite')
         else if (n_harmonics > 0) then
            call add(sentences, to_text(n_harmonics)//' harmonics of '// &
               to_text(size(model%harmonics))// &
                     ': all repeats '//to_text(minval(modes%harmonic, modes%harmonic > 0))// &
                     ' times round the circle')
         end if
         if (.not. any(modes%family == family_antisymmetric)) then
            call add(sentences, 'antisymmetric family: nothing loads it')
         else if (.not. any(modes%family == family_symmetric)) then
            call add(sentences, 'symmetric family: nothing loads it')
         end if
         if (any(modes%harmonic == 0 .and. .not. is_torsion(modes))) then
            call add(sentences, 'w of harmonic 0 symmetric: it belongs to torsion')
         end if
         if (any(is_torsion(modes))) then
            call add(sentences, 'u and v of harmonic 0 antisymmetric: torsion has w only')
         end if
         if (yields) then
            planes = new_planes(model%n_planes, modes)
            if (size(planes%angle) < size(planes%place)) then
               call add(sentences, to_text(size(planes%place) - size(planes%angle))// &
                  ' planes of '// &
                        to_text(size(planes%place))//': they are like others')
            end if
            n_elastic = count(.not. can_yield_at(model, structure%joint_points%material))
            if (n_elastic > 0) then
               call add(sentences, to_text(n_elastic)//' joint points of '// &
                        to_text(size(structure%joint_points))// &
                        ' in the iterations: they are elastic')
            end if
         end if
      end associate
   end function what_was_left_out

   !> Harmonics below the highest that HARMONICS leaves out, though joints that opened or slipped excite them
   pure function excited_in_vain(model, results) result(harmonics)
      !> The job
      type(model_type), intent(in) :: model
      !> The results, with their path
      type(results_type), intent(in) :: results
      !> The harmonics, ascending
      integer, allocatable :: harmonics(:)

      integer :: step, k

      allocate (harmonics(0))
      if (.not. any(results%path%n_slip + results%path%n_open > 0)) return
      step = 0
      do k = 1, size(results%modes)
         step = greatest_divisor(step, results%modes(k)%harmonic)
      end do
      if (step == 0) return
      do k = step, maxval(results%modes%harmonic), step
         if (.not. any(model%harmonics == k)) harmonics = [harmonics, k]
      end do
   end function excited_in_vain

   !> Whether all multiples of the least harmonic are there, as of 0, 3, 6; of 3, 9, 15 odd ones alone
   pure logical function repeats(harmonics)
      !> The harmonics; not all are zero
      integer, intent(in) :: harmonics(:)

      repeats = any(harmonics == 0)
   end function repeats

   !> Number of harmonics of the deck that no mode uses
   pure integer function count_unused(harmonics, modes) result(unused)
      !> Harmonics of the deck
      integer, intent(in) :: harmonics(:)
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)

      integer :: k

      unused = 0
      do k = 1, size(harmonics)
         if (.not. any(modes%harmonic == harmonics(k))) unused = unused + 1
      end do
   end function count_unused

   !> Add a sentence
   subroutine add(sentences, text)
      !> The sentences
      type(remark_type), allocatable, intent(inout) :: sentences(:)
      !> One more
      character(len=*), intent(in) :: text

      sentences = [sentences, remark_type(text)]
   end subroutine add

end module axijoint_analysis_core_left_out
