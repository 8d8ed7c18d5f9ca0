!> What is kept of every increment in the results file: the group /history
module axijoint_output_hdf5_history
   use, intrinsic :: iso_fortran_env, only : int8
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_series, only : series_type
   use axijoint_base_kinds, only : i8
   use axijoint_base_text, only : to_text
   use axijoint_model_model, only : model_type, bodies_yield
   use axijoint_model_request, only : is_kept, keep_displacement, keep_joints, keep_stress, &
      keep_series
   use axijoint_output_file_hdf5, only : hdf5_file_type, kind_real, kind_byte
   use axijoint_output_file_hdf5_series, only : hdf5_series_type
   use axijoint_output_file_line_values, only : line_displacements, line_stresses
   implicit none
   private
   public :: history_fields_type, begin_history, put_history, end_history, write_series

   !> Datasets that grow increment by increment
   type :: history_fields_type
      private
      !> Whether there are any: of a job of one increment there are none
      logical :: wanted = .false.
      !> Whether stresses of more than the last increment are kept: those are in /stress
      logical :: stressed = .false.
      type(hdf5_series_type) :: displacement, reaction, joint_amplitude, joint_stress, joint_state, &
         stress, nodal
      !> Of the sections
      type(hdf5_series_type), allocatable :: line_displacement(:), line_stress(:)
   end type history_fields_type

   !> The group
   character(len=*), parameter :: group = "/history"

contains

   !> Make the datasets
   subroutine begin_history(file, model, results, fields)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The datasets
      type(history_fields_type), intent(out) :: fields

      character(len=:), allocatable :: name
      integer, allocatable :: displaced(:), jointed(:), stressed(:), followed(:)
      integer :: k

      fields%wanted = size(results%states) > 1
      call file%group(group)
      if (.not. fields%wanted) return
      displaced = kept(model, results, keep_displacement)
      jointed = kept(model, results, keep_joints)
      stressed = kept(model, results, keep_stress)
      followed = kept(model, results, keep_series)
      call file%write(group//"/displacement_increment", displaced, "Increment; (kept)")
      call file%begin(fields%displacement, group//"/displacement", kind_real, &
         [shape(results%displacement, i8), size(displaced, kind=i8)], &
         "Amplitudes u, v, w; (3, node, mode, kept) [length]")
      call file%begin(fields%reaction, group//"/reaction", kind_real, &
         [shape(results%reaction, i8), size(displaced, kind=i8)], &
         "As /reaction, of the increments of displacement; (3, node, mode, kept) [force]")
      call file%write(group//"/joint_increment", jointed, "Increment; (kept)")
      call file%begin(fields%joint_amplitude, group//"/joint_amplitude", kind_real, &
         [shape(results%joint_amplitude, i8), size(jointed, kind=i8)], &
         "Amplitudes of the relative displacement xi, eta, theta; (3, point, mode, kept) [length]")
      call file%begin(fields%joint_stress, group//"/joint_stress", kind_real, &
         [shape(results%joint_stress, i8), size(jointed, kind=i8)], &
         "tau_xi, sigma, tau_theta; (3, point, plane, kept) [stress]")
      call file%begin(fields%joint_state, group//"/joint_state", kind_byte, &
         [shape(results%joint_state, i8), size(jointed, kind=i8)], &
         "0 stick, 1 slip, 2 open; (point, plane, kept)")
      fields%stressed = size(stressed) > 1
      if (fields%stressed) then
         call file%write(group//"/stress_increment", stressed, "Increment; (kept)")
         call file%begin(fields%stress, group//"/stress", kind_real, &
            [shape(results%stress, i8), size(stressed, kind=i8)], &
            "Amplitudes as in /stress/amplitude; (6, point, mode, kept) [stress]")
         call file%begin(fields%nodal, group//"/nodal_stress", kind_real, &
            [shape(results%nodal%amplitude, i8), size(stressed, kind=i8)], &
            "Amplitudes as in /stress/nodal; (6, value, mode, kept) [stress]")
      end if
      allocate (fields%line_displacement(size(model%lines)), fields%line_stress(size(model%lines)))
      if (size(model%lines) > 0) call file%group(group//"/sections")
      do k = 1, size(model%lines)
         associate (line => model%lines(k), &
                    n => size(followed, kind=i8))
            name = line_group(line%label)
            call file%group(name)
            call file%begin(fields%line_displacement(k), name//"/displacement", kind_real, &
               [3_i8, size(line%points, kind=i8), size(line%angles, kind=i8), n], &
               "Totals u, v, w; (3, row, angle, increment) [length]")
            call file%begin(fields%line_stress(k), name//"/stress", kind_real, &
               [6_i8, size(line%points, kind=i8), size(line%angles, kind=i8), n], &
               "Totals as in /sections; (6, row, angle, increment) [stress]")
         end associate
      end do
   end subroutine begin_history

   !> Append an increment
   subroutine put_history(file, model, results, i, now, fields)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end, with the states of all increments
      type(results_type), intent(in) :: results
      !> Place of the increment among the states
      integer, intent(in) :: i
      !> Its fields
      class(fields_type), intent(in) :: now
      !> The datasets
      type(history_fields_type), intent(inout) :: fields

      integer :: k

      if (.not. fields%wanted) return
      if (wants(keep_displacement)) then
         call file%append(fields%displacement, now%displacement)
         call file%append(fields%reaction, now%reaction)
      end if
      if (wants(keep_joints)) then
         call file%append(fields%joint_amplitude, now%joint_amplitude)
         call file%append(fields%joint_stress, now%joint_stress)
         call file%append(fields%joint_state, int(now%joint_state, int8))
      end if
      if (fields%stressed .and. wants(keep_stress)) then
         call file%append(fields%stress, now%stress)
         call file%append(fields%nodal, now%nodal%amplitude)
      end if
      if (.not. wants(keep_series)) return
      do k = 1, size(model%lines)
         call file%append(fields%line_displacement(k), &
            line_displacements(model, now, model%lines(k)))
         call file%append(fields%line_stress(k), line_stresses(model, now, model%lines(k)))
      end do

   contains

      !> Whether something of the increment is kept
      pure logical function wants(what)
         !> What
         integer, intent(in) :: what

         wants = is_kept(model%keep(what), results%states(i)%increment, &
                         results%states(size(results%states))%increment)
      end function wants

   end subroutine put_history

   !> Close the datasets
   subroutine end_history(file, fields)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The datasets
      type(history_fields_type), intent(inout) :: fields

      integer :: k

      if (.not. fields%wanted) return
      call file%end(fields%displacement)
      call file%end(fields%reaction)
      call file%end(fields%joint_amplitude)
      call file%end(fields%joint_stress)
      call file%end(fields%joint_state)
      if (fields%stressed) then
         call file%end(fields%stress)
         call file%end(fields%nodal)
      end if
      do k = 1, size(fields%line_stress)
         call file%end(fields%line_displacement(k))
         call file%end(fields%line_stress(k))
      end do
   end subroutine end_history

   !> Write what is followed from increment to increment
   subroutine write_series(file, model, series)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> The series
      type(series_type), intent(in) :: series

      character(len=*), parameter :: resultants = "Axial force, lateral force, moment, torque, "// &
         "lateral force and moment at 90 degrees"
      character(len=:), allocatable :: names, dissipated
      integer :: k

      call file%write(group//"/increment", series%increment, "Increment; (increment)")
      call file%write(group//"/equilibrium", series%equilibrium, "1 if in equilibrium; (increment)")
      call file%write(group//"/load_factor", series%load_factor, &
         "Sum of the load factors; (increment)")
      call file%write(group//"/case_factor", series%case_factor, &
         "Factor of each load case; (case, increment)")
      call file%write(group//"/iterations", series%iterations, "Iterations; (increment)")
      call file%write(group//"/residual", series%residual, &
         "Forces out of balance over the loads (Eq. 17); (increment)")
      call file%write(group//"/n_slip", series%n_slip, "Points times planes that slip; (increment)")
      call file%write(group//"/n_open", series%n_open, &
         "Points times planes that are open; (increment)")
      call file%write(group//"/largest_displacement", series%displacement, &
         "Largest amplitude of any component; (increment) [length]")
      call file%write(group//"/largest_pressure", series%pressure, &
         "Of joints; (increment) [stress]")
      call file%write(group//"/largest_shear", series%shear, "Of joints; (increment) [stress]")
      call file%write(group//"/work", series%work, &
         "Of loads and given displacements, by the mean of their ends; (increment) [force length]")
      call file%write(group//"/energy", series%energy, "Elastic: what solids, springs and "// &
         "joints hold of the work; (increment) [force length]")
      dissipated = "By sliding in joints"
      if (bodies_yield(model)) dissipated = dissipated//" and plastic strain"
      call file%write(group//"/dissipated", series%dissipated, dissipated// &
         ", by the mean of the stresses at the ends; (increment) [force length]")
      call file%write(group//"/applied", series%applied, resultants// &
         " of the loads; (6, increment)")
      call file%write(group//"/reacted", series%reacted, &
         resultants//" of the reactions; (6, increment)")
      call file%write(group//"/cuts", series%cuts, &
         "As /cuts/resultants; (6, cut, increment)")
      call file%write(group//"/cut_motion", series%cut_motion, &
         "As /cuts/motion; (6, cut, increment) [length, radian]")
      call file%write(group//"/joint_resultants", series%joints, &
         resultants//" that the body at side 4-3 exerts on that at side 1-2, moments about r = "// &
         "0 "// &
         "at the middle of the joint's height; (6, joint, increment)")
      call file%write(group//"/supports", series%faces, &
         "As /supports/reacted; (6, face, increment)")
      names = ""
      do k = 1, size(model%points)
         if (k > 1) names = names//new_line("a")
         names = names//trim(model%points(k)%name)
      end do
      call file%group(group//"/points")
      call file%attribute(group//"/points", "names", names)
      call file%write(group//"/points/label", (model%points%label), "Number; (point)")
      call file%write(group//"/points/position", &
         reshape([(model%points(k)%position, k=1, size(model%points))], [2, size(model%points)]), &
         "r and z; (2, point) [length]")
      call file%write(group//"/points/displacement", series%points, &
         "Amplitudes u, v, w; (3, point, mode, increment) [length]")
   end subroutine write_series

   !> Increments of which something is kept
   pure function kept(model, results, what) result(increments)
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end
      type(results_type), intent(in) :: results
      !> One of the `keep_` parameters
      integer, intent(in) :: what
      !> Their numbers
      integer, allocatable :: increments(:)

      integer :: all(size(results%states))

      all = results%states%increment
      increments = pack(all, is_kept(model%keep(what), all, all(size(all))))
   end function kept

   !> Group of a section
   pure function line_group(label) result(name)
      !> Number of the section
      integer, intent(in) :: label
      !> Its path
      character(len=:), allocatable :: name

      name = group//"/sections/"//to_text(label)
   end function line_group

end module axijoint_output_hdf5_history
