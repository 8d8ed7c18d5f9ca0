!> Reads a deck and judges what the cards alone do not tell: whether in-situ stress is in balance
module axijoint_job_reader
   use axijoint_analysis_in_situ, only : in_situ_type, in_situ_part_type, in_situ_boundary_type, misfit_type, &
      told_share, refused_share
   use axijoint_analysis_in_situ_balance, only : in_situ_balance
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, percent_text
   use axijoint_deck_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_deck_reader, only : read_deck
   use axijoint_deck_source, only : source_type
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : refinement_type
   implicit none
   private
   public :: read_job

   !> How to mend what is out of balance
   character(len=*), parameter :: or_meant = '; MEANT in columns 51-60 of INSITU says that it is meant'
   !> Directions of tractions
   character(len=1), parameter :: direction_name(2) = ['r', 'z']

contains

   !> Read a deck with all that it includes. The model is valid only if there are no errors among
   !> the messages
   subroutine read_job(path, source, model, diagnostics, refinement)
      !> The deck
      character(len=*), intent(in) :: path
      !> Its cards, for the echo and the messages
      type(source_type), intent(out) :: source
      !> The job
      type(model_type), intent(out) :: model
      !> Errors and warnings
      type(diagnostics_type), intent(out) :: diagnostics
      !> Refinement of what the deck says; none if absent
      type(refinement_type), intent(in), optional :: refinement

      call read_deck(path, source, model, diagnostics, refinement)
      if (diagnostics%n_errors > 0) return
      if (size(model%initial_stresses) > 0) call judge_in_situ(model, diagnostics)
   end subroutine read_job

   !> Tell what is out of balance in any combination, everything once
   subroutine judge_in_situ(model, diagnostics)
      !> The job
      type(model_type), intent(in) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(in_situ_type) :: findings
      logical, allocatable :: told(:, :)
      integer :: k, i

      allocate (told(3, size(model%mesh%node_label)), source=.false.)
      do k = 1, size(model%combinations)
         findings = in_situ_balance(model, model%combinations(k))
         do i = 1, size(findings%parts)
            associate (part => findings%parts(i))
               if (part%meant) cycle
               if (.not. part%has_stress) then
                  if (first_time(1, part%node)) call tell_pressed(part)
                  cycle
               end if
               if (part%weight_share > told_share) then
                  if (first_time(2, part%node)) call tell_weight(part)
               end if
               if (part%on_place%share > told_share) then
                  if (first_time(3, part%node)) call tell_traction(part)
               end if
            end associate
         end do
         if (k == 1) then
            do i = 1, size(findings%boundaries)
               if (findings%boundaries(i)%share() > told_share .and. .not. findings%boundaries(i)%meant) &
                  call tell_boundary(findings%boundaries(i))
            end do
         end if
      end do

   contains

      !> Whether a part is told about for the first time
      logical function first_time(kind, node)
         !> What is told
         integer, intent(in) :: kind
         !> A node of the part
         integer, intent(in) :: node

         first_time = .not. told(kind, node)
         told(kind, node) = .true.
      end function first_time

      !> Tell of a part whose weight is not that of its in-situ stress
      subroutine tell_weight(part)
         !> The part
         type(in_situ_part_type), intent(in) :: part

         call tell(part%card, part%weight_share, 'in-situ stress and weight of '//part_text(model, part)// &
                   ' differ by '//percent_text(part%weight_share)//when(part%weight_increment), &
                   'material '//to_text(model%materials(part%material)%label)//': gamma = '//to_text(part%gamma)// &
                   ', -density g_z = '//to_text(part%weight), &
                   'gamma = -density g_z, with GRAVITY in the load case of INSITU'//or_meant)
      end subroutine tell_weight

      !> Tell of a traction that nothing takes
      subroutine tell_traction(part)
         !> The part
         type(in_situ_part_type), intent(in) :: part

         type(misfit_type) :: worst

         worst = part%on_place
         if (part%on_whole%share > refused_share) worst = part%on_whole
         call tell(part%card, part%on_whole%share, &
                   'in-situ stress of '//part_text(model, part)//' leaves a traction of '// &
                   to_text(abs(worst%traction))//' along '//direction_name(worst%direction)//' at node '// &
                   to_text(model%mesh%node_label(worst%node))//', '//percent_text(worst%share)// &
                   trim(merge(' of its largest     ', ' of the stress there', part%on_whole%share > refused_share))// &
                   ', that no support, joint or load takes'//when(worst%increment), '', &
                   'hold the face, load it in the load case of INSITU, or mend stresses and laws of joints'//or_meant)
      end subroutine tell_traction

      !> Tell of a part that only others press
      subroutine tell_pressed(part)
         !> The part
         type(in_situ_part_type), intent(in) :: part

         call add_warning(diagnostics, 0, 0, 0, part_text(model, part)//' has no in-situ stress, but joints press '// &
                          'it with that of its neighbours, up to '//to_text(part%pressed), &
                          mend='give it an INSITU card; one with gamma = 0 and MEANT says that it has none')
      end subroutine tell_pressed

      !> Tell of materials whose stresses do not match
      subroutine tell_boundary(boundary)
         !> The boundary
         type(in_situ_boundary_type), intent(in) :: boundary

         call tell(boundary%card, boundary%share(), &
                   'in-situ stresses of materials '//to_text(model%materials(boundary%materials(1))%label)//' and '// &
                   to_text(model%materials(boundary%materials(2))%label)//' of body '//to_text(boundary%body)// &
                   ' do not match: the traction on their boundary jumps by '//to_text(boundary%jump)//' at r = '// &
                   to_text(boundary%position(1))//', z = '//to_text(boundary%position(2))//', '// &
                   percent_text(boundary%share())//' of the largest there', '', &
                   'the lower layer begins with the sigma_z that the upper one ends with (z_s, sigma_zs)'//or_meant)
      end subroutine tell_boundary

      !> Warn, or report an error beyond the limit
      subroutine tell(card, share, text, found, mend)
         !> Card of INSITU
         integer, intent(in) :: card
         !> By how much something is out of balance
         real(wp), intent(in) :: share
         !> What is wrong, what was found, how to mend it
         character(len=*), intent(in) :: text, found, mend

         if (share > refused_share) then
            call add_error(diagnostics, card, 0, 0, text, found=found, mend=mend, &
                           allowed=percent_text(refused_share)//' at most')
         else
            call add_warning(diagnostics, card, 0, 0, text, found=found, mend=mend)
         end if
      end subroutine tell

      !> Increment and combination, if there are several
      function when(increment) result(text)
         !> Increment
         integer, intent(in) :: increment
         !> Words, empty if there is one of both
         character(len=:), allocatable :: text

         text = ''
         if (size(model%increments) > 1) text = text//', after increment '//to_text(increment)
         if (size(model%combinations) > 1) text = text//', combination '//to_text(model%combinations(k)%label)
      end function when

   end subroutine judge_in_situ

   !> A part in words
   function part_text(model, part) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The part
      type(in_situ_part_type), intent(in) :: part
      !> Such as "body 2 (with node 17)"
      character(len=:), allocatable :: text

      text = 'body '//to_text(part%body)//' (with node '//to_text(model%mesh%node_label(part%node))//')'
   end function part_text

end module axijoint_job_reader
