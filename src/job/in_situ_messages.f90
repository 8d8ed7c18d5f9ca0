!> Judges what the cards alone do not tell: whether in-situ stress is in balance
module axijoint_job_in_situ_messages
   use axijoint_analysis_core_in_situ, only : in_situ_type, in_situ_part_type, &
      in_situ_boundary_type, misfit_type, &
      told_share, refused_share
   use axijoint_analysis_core_in_situ_balance, only : in_situ_balance
   use axijoint_analysis_core_in_situ_boundaries, only : place_of
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, percent_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_fe_element_kind, only : is_reduced
   use axijoint_model_load, only : covers, initial_stress_type
   use axijoint_model_material, only : rule_gauss, rule_names
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: judge_in_situ

   !> How to mend what is out of balance
   character(len=*), parameter :: or_meant = &
      '; MEANT in columns 51-60 of INSITU says that it is meant'
   !> Directions of tractions
   character(len=1), parameter :: direction_name(2) = ['r', 'z']

contains

   !> Tell what is out of balance in any combination: everything once, and again if a further
   !> combination makes an error of what was a warning
   subroutine judge_in_situ(model, diagnostics)
      !> The job
      type(model_type), intent(in) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, parameter :: pressed = 1, weight = 2, traction = 3
      type(in_situ_type) :: findings
      type(in_situ_boundary_type), allocatable :: boundaries(:)
      integer, allocatable :: told(:, :)
      logical :: rules_told
      integer :: k, i, before

      rules_told = .false.
      allocate (boundaries(0))
      allocate (told(traction, size(model%mesh%node_label)), source=0)
      do k = 1, size(model%combinations)
         findings = in_situ_balance(model, model%combinations(k))
         if (size(findings%parts) > 0 .and. .not. rules_told) call tell_rules(model, diagnostics)
         rules_told = rules_told .or. size(findings%parts) > 0
         do i = 1, size(findings%parts)
            associate (part => findings%parts(i), known => told(:, findings%parts(i)%node))
               if (part%meant) cycle
               if (part%pressed > 0.0_wp .and. known(pressed) == 0) &
                  call tell_pressed(model, part, diagnostics)
               if (part%pressed > 0.0_wp) known(pressed) = 1
               if (grade(part%weight_share, part%weight_share) > known(weight)) &
                  call tell_weight(model, k, part, diagnostics)
               if (grade(part%on_place%share, part%on_whole%share) > known(traction)) &
                  call tell_traction(model, k, part, diagnostics)
               known(weight) = max(known(weight), grade(part%weight_share, part%weight_share))
               known(traction) = max(known(traction), &
                  grade(part%on_place%share, part%on_whole%share))
            end associate
         end do
         do i = 1, size(findings%boundaries)
            associate (boundary => findings%boundaries(i))
               before = place_of(boundary, boundaries)
               if (before > 0) then
                  if (grade(boundary%share(), boundary%share()) <= &
                      grade(boundaries(before)%share(), boundaries(before)%share())) cycle
               end if
               if (.not. boundary%meant .and. grade(boundary%share(), boundary%share()) > 0) &
                  call tell_boundary(model, k, boundary, diagnostics)
               boundaries = [boundaries, boundary]
            end associate
         end do
      end do
   end subroutine judge_in_situ

   !> Tell of laws whose joints integrate stress along them otherwise than the bodies beside them, and of elements that integrate
   !> it otherwise than weight
   subroutine tell_rules(model, diagnostics)
      !> The job
      type(model_type), intent(in) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: k

      do k = 1, size(model%joint_materials)
         associate (material => model%joint_materials(k))
            if (material%rule == rule_gauss .or. .not. any(model%mesh%joint_material == k)) cycle
            call add_warning(diagnostics, 0, 0, 0, 'law '//to_text(material%label)//': points of '// &
               trim(rule_names(material%rule))//' do not integrate in-situ stress that varies along joints as the '// &
               'bodies do: ground at rest moves a little', mend='GAUSS in columns 66-75 of LAWS')
         end associate
      end do
      if (has_loose_triangles(model)) call add_warning(diagnostics, 0, 0, 0, &
         'the reduced rule of 6-node triangles does not integrate weight and in-situ stress alike: ground at rest moves, '// &
         'and its stress changes, the more the fewer rows of elements there are', &
         mend='3 in columns 16-20 of CONTROL, or 8-node elements')
   end subroutine tell_rules

   !> Whether 6-node triangles with the reduced rule have in-situ stress that grows with depth: what does not is integrated exactly
   pure logical function has_loose_triangles(model) result(has)
      !> The job
      type(model_type), intent(in) :: model

      integer :: element

      has = .false.
      associate (mesh => model%mesh)
         do element = 1, size(mesh%element_kind)
            associate (kind => mesh%kinds(mesh%element_kind(element)))
               if (kind%n_nodes /= 6 .or. .not. is_reduced(kind)) cycle
            end associate
            has = has .or. any(grows(model%initial_stresses) .and. &
               covers(model%initial_stresses, mesh%element_body(element), mesh%element_material(element)))
         end do
      end associate
   end function has_loose_triangles

   !> Whether in-situ stress grows with z
   elemental logical function grows(state)
      !> The in-situ stress
      type(initial_stress_type), intent(in) :: state

      grows = any(abs(state%gradient) > 0.0_wp)
   end function grows

   !> 0 for nothing, 1 for a warning, 2 for an error
   pure integer function grade(share, of_whole)
      !> What a warning goes by, and what an error goes by
      real(wp), intent(in) :: share, of_whole

      grade = 0
      if (share > told_share) grade = 1
      if (of_whole > refused_share) grade = 2
   end function grade

   !> Tell of a part that only others press
   subroutine tell_pressed(model, part, diagnostics)
      !> The job
      type(model_type), intent(in) :: model
      !> The part
      type(in_situ_part_type), intent(in) :: part
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      call add_warning(diagnostics, 0, 0, 0, part_text(model, part)// &
         ' has no in-situ stress, but joints press '// &
                       'it with that of its neighbours, up to '//to_text(part%pressed), &
                       mend='give it an INSITU card; one with gamma = 0, K0 = 0 and MEANT says '// &
                       'that it has none')
   end subroutine tell_pressed

   !> Tell of a part whose weight is not that of its in-situ stress
   subroutine tell_weight(model, k, part, diagnostics)
      !> The job
      type(model_type), intent(in) :: model
      !> Place of the combination
      integer, intent(in) :: k
      !> The part
      type(in_situ_part_type), intent(in) :: part
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      call tell(diagnostics, part%card, part%weight_share, 'in-situ stress and weight of '// &
                part_text(model, part)//' differ by '//percent_text(part%weight_share)// &
                when_text(model, k, part%weight_increment), &
                'gamma = -density g_z, with GRAVITY in the load case of INSITU', &
                found='material '//to_text(model%materials(part%material)%label)//': gamma = '// &
                to_text(part%gamma)//', -density g_z = '//to_text(part%weight))
   end subroutine tell_weight

   !> Tell of a traction that nothing takes
   subroutine tell_traction(model, k, part, diagnostics)
      !> The job
      type(model_type), intent(in) :: model
      !> Place of the combination
      integer, intent(in) :: k
      !> The part
      type(in_situ_part_type), intent(in) :: part
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(misfit_type) :: worst
      character(len=:), allocatable :: whole

      worst = part%on_place
      whole = ' of the stress there'
      if (part%on_whole%share > refused_share) then
         worst = part%on_whole
         whole = ' of its largest'
      end if
      call tell(diagnostics, part%card, part%on_whole%share, 'in-situ stress of '// &
         part_text(model, part)// &
                ' leaves a traction of '//to_text(abs(worst%traction))//' along '// &
                direction_name(worst%direction)//' at node '// &
                to_text(model%mesh%node_label(worst%node))//', '// &
                percent_text(worst%share)//whole//', that no support, joint or load takes'// &
                when_text(model, k, worst%increment), &
                'hold the face, load it in the load case of INSITU, or mend stresses and laws '// &
                'of joints')
   end subroutine tell_traction

   !> Tell of materials whose stresses do not match
   subroutine tell_boundary(model, k, boundary, diagnostics)
      !> The job
      type(model_type), intent(in) :: model
      !> Place of the combination
      integer, intent(in) :: k
      !> The boundary
      type(in_situ_boundary_type), intent(in) :: boundary
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: sides

      associate (labels => model%materials(boundary%materials)%label, bodies => boundary%bodies)
         if (bodies(1) == bodies(2)) then
            sides = 'materials '//to_text(labels(1))//' and '//to_text(labels(2))//' of body '//to_text(bodies(1))
         else
            sides = 'bodies '//to_text(bodies(1))//' and '//to_text(bodies(2))//', which are bonded,'
         end if
         call tell(diagnostics, boundary%card, boundary%share(), 'in-situ stresses of '//sides// &
                   ' do not match: the traction on their boundary jumps by '// &
                   to_text(boundary%jump)//' at r = '// &
                   to_text(boundary%position(1))//', z = '//to_text(boundary%position(2))//', '// &
                   percent_text(boundary%share())//' of the largest there'// &
                   when_text(model, k, boundary%increment), &
                   'the lower layer begins with the sigma_z that the upper one ends with (z_s, '// &
                   'sigma_zs)')
      end associate
   end subroutine tell_boundary

   !> Warn, or report an error beyond the limit
   subroutine tell(diagnostics, card, share, text, mend, found)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Card of INSITU
      integer, intent(in) :: card
      !> By how much something is out of balance
      real(wp), intent(in) :: share
      !> What is wrong, and how to mend it
      character(len=*), intent(in) :: text, mend
      !> What was found
      character(len=*), intent(in), optional :: found

      if (share > refused_share) then
         call add_error(diagnostics, card, 0, 0, text, found=found, mend=mend//or_meant, &
                        allowed=percent_text(refused_share)//' at most')
      else
         call add_warning(diagnostics, card, 0, 0, text, found=found, mend=mend//or_meant)
      end if
   end subroutine tell

   !> Increment and combination, if there are several
   function when_text(model, k, increment) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Place of the combination, and increment
      integer, intent(in) :: k, increment
      !> Words, empty if there is one of both
      character(len=:), allocatable :: text

      text = ''
      if (size(model%increments) > 1) text = text//', after increment '//to_text(increment)
      if (size(model%combinations) > 1) &
         text = text//', combination '//to_text(model%combinations(k)%label)
   end function when_text

   !> A part in words
   function part_text(model, part) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The part
      type(in_situ_part_type), intent(in) :: part
      !> Such as "body 2 (with node 17)"
      character(len=:), allocatable :: text

      text = 'body '//to_text(part%body)//' (with node '// &
         to_text(model%mesh%node_label(part%node))//')'
   end function part_text

end module axijoint_job_in_situ_messages
