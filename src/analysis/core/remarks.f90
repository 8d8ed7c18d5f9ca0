!> Sentences about results that the user should know
module axijoint_analysis_core_remarks
   use axijoint_analysis_core_left_out, only : excited_in_vain
   use axijoint_analysis_core_motion, only : motion_text
   use axijoint_analysis_core_pins, only : pin_text
   use axijoint_analysis_core_proportion_remarks, only : proportion_remarks
   use axijoint_analysis_core_results, only : results_type, remark_type, source_names, source_discretization, source_iteration, &
      source_harmonics
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_totals, only : largest_displacement, peak_type
   use axijoint_analysis_fine_walls, only : most_across, longest_seen, longest_by_stress
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text, count_of, name_of, list_of, percent_text
   use axijoint_element_joint_law, only : joint_law_type, opening_reversible, eta, state_stick
   use axijoint_fe_element_kind, only : is_reduced, reduced_hint
   use axijoint_joints_field, only : joint_field_type, n_across_gaps, n_fading
   use axijoint_joints_history, only : history_type
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_watch, only : runaway
   use axijoint_model_locking, only : has_nearly_incompressible
   use axijoint_model_model, only : model_type, bodies_yield, left_out_harmonics
   use axijoint_model_request, only : goal_joints, goal_names, refinement_type, is_kept, keep_series
   implicit none
   private
   public :: remarks_on, remark_on_goal, mechanism_text

   !> Joints whose k h/E is above this are of no sensible proportion
   real(wp), parameter :: stiffest = 1.0e4_wp
   !> Tolerances above this deserve a word
   real(wp), parameter :: coarse_tolerance = 1.0e-3_wp
   !> How many times the residual-force ratio of a linear job stresses may be off, and how much of that deserves a word: in most
   !> bodies, and in nearly incompressible ones (1.3 and 1.6e4 times were seen; test/decks/limits.py)
   real(wp), parameter :: lost = 2.0_wp, shows = 2.0e-6_wp, mean_lost = 2.0e4_wp, mean_shows = 1.0e-3_wp
   !> So many harmonics or increments are named
   integer, parameter :: most_named = 8
   !> Part of the largest stress by which sums of harmonics may be beside yield criteria without a word
   real(wp), parameter :: much_beside = 0.05_wp

contains

   !> What the user should know about the results
   function remarks_on(model, structure, history, field, results) result(remarks)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences
      type(remark_type), allocatable :: remarks(:)

      character(len=:), allocatable :: pins
      integer :: i

      allocate (remarks(0))
      if (size(results%path) > 0) then
         call remark_on_end(model, structure, history, results, remarks)
      else if (.not. results%converged .and. results%uncertain > 0.0_wp) then
         call add(remarks, 'rounding in the solver leaves displacements uncertain by '// &
                  to_text(results%uncertain)// &
                  ' of the largest: stiffnesses out of all proportion?')
      else if (.not. results%converged) then
         call add(remarks, 'the equations are ill-conditioned (condition number '// &
                  to_text(maxval(results%solves%condition))//', residual '// &
                  to_text(results%residual_ratio)//'): stiffnesses, or a length beside a thickness, out of all proportion?')
      else if (has_nearly_incompressible(model)) then
         call add_rounding(mean_lost*results%residual_ratio, mean_shows)
      else
         call add_rounding(lost*results%residual_ratio, shows)
      end if
      if (.not. (results%converged .or. allocated(results%mechanism))) remarks(size(remarks))%says_why = .true.
      if (.not. results%converged .and. size(results%path) == 0 .and. any(is_reduced(model%mesh%kinds))) &
         call add(remarks, reduced_hint)
      if (results%converged .and. is_loose(model, results)) call add(remarks, reduced_hint)
      if (size(results%path) > 0) call remark_on_accuracy(model, structure, field, results, remarks)
      call remark_on_cut_off(model, abs(history%loading%case_factor) > 0.0_wp, results, remarks)
      if (results%plastic%beside > much_beside) call add(remarks, 'stresses of bodies that yield are sums of harmonics, up to '// &
         percent_text(results%plastic%beside)//' of the largest beside what the criteria admit on their planes '// &
         '(/yield/stress)')
      call remark_on_size(model, results, remarks)
      if (results%locks .and. allocated(results%budget)) call add(remarks, 'elements of a material that is nearly '// &
         'incompressible lock, or nearly so beside corners, and finer ones as well: estimates of errors see little of that; '// &
         '4-node BBAR and 6-node elements do not')
      if (results%bends_unseen .and. allocated(results%budget)) call add(remarks, 'walls of more than '//to_text(most_across)// &
         ' elements across, which are long beside the thickness of the wall: estimates of errors see a part of how these bend; '// &
         'shorter elements, or fewer across, are judged in full')
      if (results%edges_unseen .and. allocated(results%budget)) call add(remarks, 'walls with elements at their edges longer '// &
         'than '//to_text(longest_seen)//' times the root of radius times thickness: estimates of errors see next to nothing '// &
         'of how they bend there; shorter elements at the edges are judged in full')
      if (results%stress_in_part .and. .not. results%edges_unseen .and. allocated(results%budget) .and. size(model%lines) > 0) &
         call add(remarks, 'walls with elements at their edges longer than '//to_text(longest_by_stress)//' times the root of '// &
         'radius times thickness: estimates of errors see a part of how stresses change there, so those on SECTIONS are told '// &
         'as "at least"')
      pins = pin_text(model, structure, history%loading, field, results)
      if (len(pins) > 0) call add(remarks, pins)
      if (allocated(results%stiffer)) remarks = [remarks, proportion_remarks(model, results)]
      associate (last => size(model%increments))
         if (.not. all(is_kept(model%keep(keep_series), [(i, i=1, last)], last))) call add(remarks, &
            'work and dissipation are sums over the increments that SERIES of KEEP keeps: of longer steps than were made')
      end associate

   contains

      !> What rounding may leave of stresses of a linear job, if it is more than deserves a word
      subroutine add_rounding(off, least)
         !> That, and what deserves a word
         real(wp), intent(in) :: off, least

         if (off > least) call add(remarks, 'displacements are large beside what strains bodies, or strains beside changes of '// &
            'volume (condition number '//to_text(maxval(results%solves%condition))//'): rounding may leave stresses off by '// &
            to_text(off)//' of the largest, displacements by less')
      end subroutine add_rounding

   end function remarks_on

   !> What it tells of a run without equilibrium that no joint point sticks: nothing if some do
   pure function nothing_sticks_text(results) result(text)
      !> The results
      type(results_type), intent(in) :: results
      !> The end of a sentence
      character(len=:), allocatable :: text

      text = ''
      if (size(results%joint_state) == 0 .or. any(results%joint_state == state_stick)) return
      text = '; no joint point sticks, so joints may carry no more: given displacements (MOVEDFACES) go past a limit'
   end function nothing_sticks_text

   !> Increments that were halved where joints slip: the path is another one then
   subroutine remark_on_steps(results, remarks)
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences, to be continued
      type(remark_type), allocatable, intent(inout) :: remarks(:)

      integer, allocatable :: halved(:)
      integer :: i

      if (.not. (results%converged .and. any(results%path%n_slip > 0))) return
      halved = [(i, i=1, maxval([0, results%residuals%increment]))]
      halved = pack(halved, [(count(results%residuals%increment == i) > 1, i=1, size(halved))])
      if (size(halved) == 0) return
      call add(remarks, trim(merge('increment ', 'increments', size(halved) == 1))//' '// &
         list_of(halved, most_named)// &
         ' in smaller steps, as no equilibrium was found at once: what slips depends on the path, of which estimates of errors '// &
         'know nothing; more increments show how much')
   end subroutine remark_on_steps

   !> Whether 9-node elements with the reduced rule may move almost freely: errors are told as large as displacements are
   pure logical function is_loose(model, results)
      !> The job
      type(model_type), intent(in) :: model
      !> The results
      type(results_type), intent(in) :: results

      real(wp), parameter :: large = 0.5_wp

      is_loose = .false.
      if (.not. allocated(results%budget)) return
      is_loose = any(model%mesh%kinds%n_nodes == 9 .and. is_reduced(model%mesh%kinds)) .and. &
         results%budget(source_discretization)%displacement > large
   end function is_loose

   !> A load of which much is above M, where estimates know nothing of what that does: with harmonics 0 and 1 alone
   subroutine remark_on_cut_off(model, acts, results, remarks)
      !> The job
      type(model_type), intent(in) :: model
      !> Which load cases act, shape (cases)
      logical, intent(in) :: acts(:)
      !> The results, with their errors
      type(results_type), intent(in) :: results
      !> The sentences, to be continued
      type(remark_type), allocatable, intent(inout) :: remarks(:)

      !> Part of a load that is worth a word
      real(wp), parameter :: much = 0.05_wp
      integer, allocatable :: left_out(:)

      left_out = left_out_harmonics(model, acts)
      if (size(left_out) > 0) call add(remarks, 'loads have parts in harmonics that HARMONICS leaves out, too, whose share of '// &
         'the answer is not known: '//list_of(left_out, most_named))
      if (.not. allocated(results%budget)) return
      associate (share => results%budget(source_harmonics))
         if (share%displacement >= 0.0_wp .or. .not. share%load > much .or. share%load >= 1.0_wp) return  ! 1: a load at a point
         call add(remarks, 'the harmonics in use leave out '//to_text(0.1_wp*nint(1.0e3_wp*share%load))//' % of a load, and '// &
            'what that changes is not known: more of them show it (M in CONTROL'// &
            trim(merge(', HARMONICS)', ')           ', size(model%harmonics) <= model%max_harmonic)))
      end associate
   end subroutine remark_on_cut_off

   !> Displacements that are zero, or no longer small: forces are in equilibrium at the places that nodes had before, and joints meet
   !> the points that they met there. Mostly units are mixed up
   subroutine remark_on_size(model, results, remarks)
      !> The job
      type(model_type), intent(in) :: model
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences, to be continued
      type(remark_type), allocatable, intent(inout) :: remarks(:)

      !> Part of the larger of diameter and height that is worth a word: a body turned by so much, in radian, is lengthened by
      !> an eighth of a percent that is none
      real(wp), parameter :: large = 0.05_wp
      type(peak_type) :: peak
      real(wp) :: extent

      if (.not. (results%converged .or. allocated(results%mechanism) .or. results%strayed)) return  ! no equilibrium
      peak = largest_displacement(results%modes, results%displacement)
      if (results%converged .and. .not. peak%value > 0.0_wp .and. size(model%increments) <= 1) &
         call add(remarks, 'nothing moves: loads are zero, or act on what is held')
      associate (r => model%mesh%coordinates(1, :), z => model%mesh%coordinates(2, :))
         extent = max(2.0_wp*maxval(r), maxval(z) - minval(z))
      end associate
      if (.not. peak%value > large*extent) return
      call add(remarks, 'displacements are not small: up to '//to_text(peak%value)//', '// &
         to_text(0.1_wp*nint(1.0e3_wp*min(peak%value/extent, 1.0e6_wp)))//' % of diameter or height; equilibrium is that of '// &
         'bodies as they were before. Units of stiffnesses and loads?')
   end subroutine remark_on_size

   !> How the increments ended: what moves, what might as well stand elsewhere, what slip on the way leaves, and why there is no
   !> equilibrium if there is none
   subroutine remark_on_end(model, structure, history, results, remarks)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences, to be continued
      type(remark_type), allocatable, intent(inout) :: remarks(:)

      integer :: i

      if (allocated(results%mechanism)) then
         call add(remarks, results%mechanism, elsewhere=.true.)
      else if (.not. (results%converged .or. history%verdict%converged)) then
         call add(remarks, 'the last equilibrium was at the load factor '//to_text(history%reached)//nothing_sticks_text(results))
      end if
      if (allocated(results%idle)) then
         do i = 1, size(results%idle)
            call add(remarks, 'nothing resists and nothing loads it: '//trim(results%idle(i))//trim(merge( &
                     '; it stands where it stood before ', '; it might as well stand elsewhere', results%stands(i))))
         end do
      end if
      if (allocated(model%turning)) then
         do i = 1, size(model%turning)
            call add(remarks, 'nothing resists and nothing loads it: the part with node '// &
                     to_text(model%mesh%node_label(model%turning(i)))//' turns about z (harmonic 0 antisymmetric), '// &
                     'with all that joints hold to it; it might as well stand elsewhere')
         end do
      end if
      if (history%n_faded > 0) call add(remarks, fading_text(history))
      call remark_on_way(results, remarks)
      if (history%verdict%at_rounding .and. .not. results%unsettled > 0.0_wp) then
         call add(remarks, 'rounding allows no smaller residual ratio: the stress of open joints so stiff is large; '// &
                  within_reach(10.0_wp*results%residual_ratio))
      else if (.not. (results%converged .or. allocated(results%mechanism))) then
         call add(remarks, no_equilibrium_text(model, structure, history, results))
      end if
   end subroutine remark_on_end

   !> What slip, bonds and softening on the way leave that estimates of errors know nothing of, or not all
   subroutine remark_on_way(results, remarks)
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences, to be continued
      type(remark_type), allocatable, intent(inout) :: remarks(:)

      if (results%keeps_slip .and. results%follows_all_slip) then
         call add(remarks, 'joints slipped in earlier increments, and more than half of a load was taken away since, or they '// &
            'slip all together: errors are rests of larger ones, and a part that slides as a whole stands as wrong as it did then')
      else if (results%keeps_slip .and. results%follows_slip) then
         call add(remarks, 'joints that slipped in earlier increments hold now, slipped back, or slip all together: what '// &
            'planes and harmonics had wrong then stays in the slip and is not all counted in the errors, nor where a part '// &
            'stands that slides as a whole; what the mesh had wrong is')
      else if (results%keeps_slip) then
         call add(remarks, 'joints that slipped in earlier increments hold now, slipped back, or slip all together: what '// &
            'was wrong then stays in the slip and is not counted in the errors')
      end if
      if (results%torn) call add(remarks, 'some bonds broke and others hold: which of them hangs on their order, of which '// &
         'estimates of joint stress know nothing; more increments show how much')
      if (results%soft_in_part) call add(remarks, 'some points softened as they slipped and others did not: which of them '// &
         'hangs on their order, of which estimates of errors know nothing; finer meshes and more increments show how much')
      if (results%turns_slip) call add(remarks, 'slip of joints turns within an increment: how far they slide depends '// &
         'on the way there, of which estimates of errors know nothing; more increments show how much')
   end subroutine remark_on_way

   !> Why the last step is no equilibrium, or not one that the tolerance may claim
   function no_equilibrium_text(model, structure, history, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> The results
      type(results_type), intent(in) :: results
      !> Words
      character(len=:), allocatable :: text

      if (history%newton_finds) then
         text = 'the iterations run away from a state that NEWTON finds: name that method in CONTROL'
      else if (results%unsettled > 0.0_wp) then
         text = 'forces are balanced to the tolerance, but the iterations leave displacements or joint stresses uncertain by '// &
            to_text(results%unsettled)//' of the largest, more than 10 times it'
      else if (results%uncertain > 0.0_wp) then
         text = 'forces are balanced to the tolerance, but rounding in the solver leaves displacements uncertain by '// &
            to_text(results%uncertain)//' of the largest, more than 10 times it'
      else if (history%verdict%converged .or. (results%residual_ratio <= results%tolerance .and. &
               results%mismatch > results%tolerance)) then
         text = trim(merge('bodies that yield', 'the joints       ', bodies_yield(model)))// &
            ' are balanced to the tolerance, the whole structure is not: rounding; '// &
            within_reach(10.0_wp*max(results%residual_ratio, results%mismatch))
      else if (history%verdict%ran_away) then
         text = 'the iterations run away: joints move more than '//to_text(runaway)//' times as far as elastic joints'
      else if (.not. history%verdict%stalled) then
         text = 'INCREMENTS allows no more iterations'
      else if (.not. any(history%verdict%restless)) then
         text = 'the residual ratio does not fall any more, though no joint point changes its state'//advice(model, structure)
      else
         text = to_text(count(history%verdict%restless))//' joint points on planes change their state for ever'// &
            period_text(results%path)//restless_text(model, structure, history, results)//advice(model, structure)
      end if
   end function no_equilibrium_text

   !> Words about cohesion that fades: how many points have a part of it, and how far they are open
   function fading_text(history) result(text)
      !> What the increments came to
      type(history_type), intent(in) :: history
      !> Words
      character(len=:), allocatable :: text

      associate (field => history%field, laws => history%scene%laws)
         text = 'cohesion fades over an opening in '//to_text(history%n_faded)//' of the load '// &
            'steps, where the law, which loses it at once, has no equilibrium'
         if (field%fading > 0.0_wp) text = text//'; at the end at '// &
            to_text(n_fading(laws, field))//' joint points on planes, over '//to_text(maxval( &
            field%fading*laws%edge*laws%cohesion/laws%stiffness(eta), laws%stiffness(eta) > 0.0_wp))
      end associate
   end function fading_text

   !> After how many iterations the path repeats itself, in words
   pure function period_text(path) result(text)
      !> Convergence path
      type(iteration_type), intent(in) :: path(:)
      !> Words; empty if it does not
      character(len=:), allocatable :: text

      real(wp), parameter :: alike = 1.0e-2_wp
      integer, parameter :: longest = 12
      integer :: n, p

      text = ''
      n = size(path)
      do p = 1, min(longest, (n - 1)/3)
         associate (last => path(n - 2*p + 1:n), before => path(n - 3*p + 1:n - p))
            if (any(last%n_slip /= before%n_slip .or. last%n_open /= before%n_open)) cycle
            if (any(abs(last%ratio - before%ratio) > alike*before%ratio)) cycle
         end associate
         text = ', alike every '//to_text(p)//' iterations'
         return
      end do
   end function period_text

   !> What helps: only cohesion that comes back when a point closes makes the law jump
   pure function advice(model, structure) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> Words
      character(len=:), allocatable :: text

      text = ''
      associate (laws => model%joint_materials(structure%condensed%points%material)%law)
         if (any(laws%cohesion > 0.0_wp .and. laws%opening == opening_reversible)) then
            text = ': try BOND in LAWDETAILS'
         end if
      end associate
   end function advice

   !> The first of the points that change their state for ever
   function restless_text(model, structure, history, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> How the increments ended
      type(history_type), intent(in) :: history
      !> The results
      type(results_type), intent(in) :: results
      !> Joint and plane, in brackets
      character(len=:), allocatable :: text

      integer :: place(2)

      text = ''
      place = findloc(history%verdict%restless, .true.)
      if (any(place == 0)) return
      text = ' (joint '// &
         to_text(model%mesh%joint_label(structure%condensed%points(place(1))%joint))// &
         ' at theta = '//to_text(results%plane_angles(place(2))/degree)//', ...)'
   end function restless_text

   !> How far results that are there can be trusted
   subroutine remark_on_accuracy(model, structure, field, results, remarks)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, for its joint points
      type(structure_type), intent(in) :: structure
      !> State of the joints
      type(joint_field_type), intent(in) :: field
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences, to be continued
      type(remark_type), allocatable, intent(inout) :: remarks(:)

      type(joint_law_type), allocatable :: laws(:)
      real(wp) :: widest
      integer :: n

      if (results%accumulated) then
         laws = model%joint_materials(structure%joint_points%material)%law
         call n_across_gaps(laws, field, n, widest)
         if (n > 0) call add(remarks, 'pressure across an open gap at '//to_text(n)// &
            ' joint points on planes (widest '//to_text(widest)// &
            '): stress accumulated, as in the paper')
         if (any(model%joint_materials%law%gap > 0.0_wp)) then
            call add(remarks, 'the loop of TRANSFER knows no gap before loading: those of '// &
               'LAWDETAILS are left out')
         end if
      end if
      if (results%tolerance > coarse_tolerance .and. .not. leaves_little(results)) then
         call add(remarks, 'a tolerance of '//to_text(results%tolerance)// &
            trim(merge(' leaves   ', ' may leave', allocated(results%budget)))// &
            trim(merge(' joint stresses    ', ' stresses and loads', size(structure%yielding) > 0))// &
            ' several per cent wrong (default 1E-6)')
      end if
      if (results%part_error > max(results%tolerance, coarse_tolerance)) then
         call add(remarks, 'forces of '//to_text(results%part_error)// &
            ' of the load are not balanced on some part: see EQUILIBRIUM')
      end if
      associate (last => results%path(size(results%path)))
         associate (laws => model%joint_materials(structure%condensed%points%material)%law)
            if (last%n_slip > 0 .and. last%n_open > 0 .and. any(laws%cohesion > 0.0_wp .and. laws%dilation > 0.0_wp &
                                                                .and. laws%opening == opening_reversible)) then
               call add(remarks, 'cohesion that comes back, beside dilation: other states may be in equilibrium, '// &
                  'far from this one; steps and mesh decide. BOND in LAWDETAILS lets none come back')
            end if
         end associate
         if (last%n_slip + last%n_open > 0 .and. all(model%harmonics > 0)) then
            call add(remarks, 'joints that open or slip act in harmonic 0, '// &
               'which HARMONICS leaves out: results may be far off')
         end if
      end associate
      call remark_on_gaps(model, results, remarks)
      call remark_on_steps(results, remarks)
      if (maxval(results%modes%harmonic) + 1 == model%n_planes) then
         call add(remarks, 'w of the highest harmonic vanishes on all planes: '// &
            'nothing of it is transferred (M + 2 planes avoid that)')
      end if
   end subroutine remark_on_accuracy

   !> Harmonics below the highest that HARMONICS leaves out, though joints that opened or slipped excite them: estimates
   !> compare with more harmonics above M only
   subroutine remark_on_gaps(model, results, remarks)
      !> The job
      type(model_type), intent(in) :: model
      !> The results
      type(results_type), intent(in) :: results
      !> The sentences, to be continued
      type(remark_type), allocatable, intent(inout) :: remarks(:)

      integer, allocatable :: left_out(:)

      left_out = excited_in_vain(model, results)
      if (size(left_out) == 0) return
      call add(remarks, 'joints that open or slip act in harmonics that HARMONICS leaves out, too, which estimates of errors '// &
         'do not know: '//list_of(left_out, most_named))
   end subroutine remark_on_gaps

   !> Whether the rounds of refinement met the target, and if not, why
   subroutine remark_on_goal(model, refinement, note, unknown, results)
      !> The job
      type(model_type), intent(in) :: model
      !> How it was refined in the end
      type(refinement_type), intent(in) :: refinement
      !> Why its mesh was not made anew; empty if there is nothing to say
      character(len=*), intent(in) :: note
      !> Source of error whose share is not known, 0 if all are
      integer, intent(in) :: unknown
      !> The results, with their rounds
      type(results_type), intent(inout) :: results

      character(len=:), allocatable :: why

      if (allocated(refinement%mesh_file)) call add(results%remarks, 'the mesh is '// &
         name_of(refinement%mesh_file)//', which Gmsh made of '//name_of(model%error_goal%geometry))
      if (.not. results%converged) return
      associate (last => results%rounds(size(results%rounds)), goal => model%error_goal)
         if (last%error >= 0.0_wp .and. last%error <= goal%target .and. unknown == 0) return
         if (allocated(last%failure)) then
            why = 'round '//to_text(size(results%rounds))//' '//last%failure// &
               '; these are the results of round '// &
                  to_text(size(results%rounds) - 1)
         else if (last%error < 0.0_wp) then
            why = 'the error of '//trim(goal_names(goal%quantity))//' is not known'
            if (any(model%truncations%left_out >= 1.0_wp)) &
               why = why//', as some load is concentrated in points'
         else if (last%error <= goal%target .and. results%locks) then
            why = 'elements lock'
         else if (last%error <= goal%target .and. results%torn .and. goal%quantity == goal_joints) then
            why = 'which bonds break hangs on their order'
         else if (last%error <= goal%target .and. results%soft_in_part) then
            why = 'which points soften hangs on their order'
         else if (last%error <= goal%target .and. results%turns_slip) then
            why = 'slip turns within an increment'
         else if (last%error <= goal%target .and. results%keeps_slip) then
            why = 'of what slipped in earlier increments not all errors are known'
         else if (last%error <= goal%target) then
            why = 'the share of '//trim(source_names(unknown))//' is not known'
         else if (size(results%rounds) >= goal%most_rounds) then
            why = 'so many rounds are allowed'
            if (len(note) > 0) why = why//'; '//note
         else if (len(note) > 0) then
            why = note
         else if (size(model%harmonics) <= model%max_harmonic .and. 2.0_wp*last%n_unknowns < goal%most_unknowns) then
            why = 'HARMONICS lists which there are, and no others are taken'
         else if (goal%mesh_too .or. goal%remesh) then
            why = 'more unknowns are not allowed'
         else
            why = 'its mesh is neither of BLOCKS nor of a mesh file alone, or cards call nodes by number'
         end if
         results%missed = 'the error target of '//to_text(100.0_wp*goal%target)//' % was not met in '// &
            count_of(size(results%rounds), 'round')//': '//why
         call add(results%remarks, results%missed, elsewhere=.true.)
      end associate
   end subroutine remark_on_goal

   !> Whether the iteration is known to leave little of joint stress
   pure logical function leaves_little(results)
      !> The results
      type(results_type), intent(in) :: results

      real(wp), parameter :: little = 0.01_wp

      leaves_little = .false.
      if (.not. allocated(results%budget)) return
      associate (error => results%budget(source_iteration)%joint_stress)
         leaves_little = error >= 0.0_wp .and. error <= little
      end associate
   end function leaves_little

   !> What tolerance could be reached
   pure function within_reach(tolerance) result(text)
      !> The tolerance
      real(wp), intent(in) :: tolerance
      !> The words
      character(len=:), allocatable :: text

      text = 'a tolerance of '//to_text(tolerance)//' can be reached'
      if (.not. tolerance < 1.0_wp) text = 'no tolerance can be reached: stiffnesses out of all proportion, '// &
         'or next to nothing that holds a part?'
   end function within_reach

   !> Add a sentence
   subroutine add(remarks, text, elsewhere)
      !> The sentences
      type(remark_type), allocatable, intent(inout) :: remarks(:)
      !> One more
      character(len=*), intent(in) :: text
      !> Whether the lines for the screen have it without it; false if absent
      logical, intent(in), optional :: elsewhere

      remarks = [remarks, remark_type(text)]
      if (present(elsewhere)) remarks(size(remarks))%said_elsewhere = elsewhere
   end subroutine add

   !> A mechanism in words
   function mechanism_text(model, reached, case_factor, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Load factor of the last equilibrium, a sum where increments are of single cases, and factors of the cases
      real(wp), intent(in) :: reached, case_factor(:)
      !> Results with the displacements that ran away
      type(results_type), intent(in) :: results
      !> The sentence
      character(len=:), allocatable :: text

      text = 'no equilibrium was found beyond the load factor '//to_text(reached)//': '// &
         motion_text(model%mesh, results%modes, results%displacement)//'; results are those there'// &
         cases_text(model, reached, case_factor)
   end function mechanism_text

   !> Factors of the load cases; nothing where there is one alone, with that of the whole
   function cases_text(model, reached, case_factor) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Load factor of the whole, and factors of the cases
      real(wp), intent(in) :: reached, case_factor(:)
      !> Such as ', case 1 at 1, case 2 at 0.978', or that none is on, where increments are of cases that a combination lacks
      character(len=:), allocatable :: text

      !> Rounding of sums of factors
      real(wp), parameter :: rounding = 1.0e-12_wp
      integer :: k

      text = ''
      if (reached > 0.0_wp .and. .not. any(abs(case_factor) > 0.0_wp)) text = ', where none of its load cases is on yet'
      if (count(abs(case_factor) > 0.0_wp) < 2 .and. all(abs(case_factor - reached) <= rounding*abs(reached) &
         .or. abs(case_factor) <= 0.0_wp)) return
      do k = 1, size(case_factor)
         if (abs(case_factor(k)) > 0.0_wp) text = text//', case '//to_text(model%load_cases(k)%label)//' at '// &
            to_text(case_factor(k))
      end do
   end function cases_text

end module axijoint_analysis_core_remarks
