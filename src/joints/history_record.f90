!> A history as bytes, and back: all that the next step starts from and that results are read from.
!> What follows from the job alone – laws, planes, the method – is not there, nor what loads do to
!> the nodes, which follows from the factors of the load cases.
module axijoint_joints_history_record
   use axijoint_base_kinds, only : wp
   use axijoint_base_stream, only : writer_type, reader_type
   use axijoint_element_joint_law, only : memory_type
   use axijoint_joints_field, only : joint_field_type
   use axijoint_joints_history, only : history_type
   use axijoint_joints_load_steps, only : step_type
   use axijoint_joints_loads, only : joint_loads_type
   use axijoint_joints_method, only : control_type, verdict_type
   use axijoint_joints_path, only : iteration_type
   use axijoint_joints_residual, only : residual_record_type
   use axijoint_joints_states, only : increment_state_type, plastic_state_type
   implicit none
   private
   public :: write_history, read_history

contains

   !> Write a history whose last step is in equilibrium
   subroutine write_history(history, writer)
      !> The history
      type(history_type), intent(in) :: history
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      integer :: k

      call writer%put(history%increment)
      call write_step(history%at, writer)
      call writer%put(size(history%ahead))
      do k = 1, size(history%ahead)
         call write_step(history%ahead(k)%step, writer)
         call writer%put(history%ahead(k)%halvings)
         call writer%put(history%ahead(k)%helps)
      end do
      call write_control(history%control, writer)
      call write_loads(history%scene%loads, writer)
      call write_field(history%field, writer)
      call write_verdict(history%verdict, writer)
      call writer%put(history%loading%case_factor)
      call writer%put(history%peak%case_factor)
      call writer%put(history%peak_norm)
      call writer%put(history%load_norm)
      call writer%put(history%balanced)
      call writer%put(history%motion)
      call writer%put(history%failed_share)
      call writer%put(history%reached)
      call writer%put(history%n_faded)
      call writer%put(history%largest_elastic)
      call writer%put(history%largest_stress)
      call write_memory(history%memory, writer)
      call write_memory(history%start, writer)
      call writer%put(history%noted)
      call write_path(history%path, writer)
      call writer%put(size(history%states))
      do k = 1, size(history%states)
         call write_state(history%states(k), writer)
      end do
      call writer%put(size(history%residuals))
      do k = 1, size(history%residuals)
         call write_residual(history%residuals(k), writer)
      end do
      call writer%put(history%beside)
   end subroutine write_history

   !> Read a history
   subroutine read_history(reader, history)
      !> The bytes; failed if they are of no history, or of one on another structure
      type(reader_type), intent(inout) :: reader
      !> The history, new; of the loads on the nodes it takes the factors of the load cases
      type(history_type), intent(inout) :: history

      type(joint_field_type) :: fresh
      integer :: k, n

      fresh = history%field
      call reader%get(history%increment)
      call read_step(reader, history%at)
      call read_count(reader, n)
      deallocate (history%ahead)
      allocate (history%ahead(n))
      do k = 1, n
         call read_step(reader, history%ahead(k)%step)
         call reader%get(history%ahead(k)%halvings)
         call reader%get(history%ahead(k)%helps)
      end do
      call read_control(reader, history%control)
      call read_loads(reader, history%scene%loads)
      call read_field(reader, history%field)
      call read_verdict(reader, history%verdict)
      call reader%get(history%loading%case_factor)
      call reader%get(history%peak%case_factor)
      call reader%get(history%peak_norm)
      call reader%get(history%load_norm)
      call reader%get(history%balanced)
      call reader%get(history%motion)
      call reader%get(history%failed_share)
      call reader%get(history%reached)
      call reader%get(history%n_faded)
      call reader%get(history%largest_elastic)
      call reader%get(history%largest_stress)
      call read_memory(reader, history%memory)
      call read_memory(reader, history%start)
      call reader%get(history%noted)
      call read_path(reader, history%path)
      call read_count(reader, n)
      deallocate (history%states)
      allocate (history%states(n))
      do k = 1, n
         call read_state(reader, history%states(k))
      end do
      call read_count(reader, n)
      deallocate (history%residuals)
      allocate (history%residuals(n))
      do k = 1, n
         call read_residual(reader, history%residuals(k))
      end do
      call reader%get(history%beside)
      if (.not. reader%at_end()) reader%failed = .true.
      if (.not. reader%failed) reader%failed = .not. fits(history%field, fresh)
   end subroutine read_history

   !> Whether a field has the points, planes and modes of another
   pure logical function fits(field, other)
      !> The fields
      type(joint_field_type), intent(in) :: field, other

      fits = .false.
      if (.not. (allocated(field%jump) .and. allocated(field%excess) .and. &
                 allocated(field%offset))) return
      fits = all(shape(field%jump) == shape(other%jump)) .and. &
         all(shape(field%excess) == shape(other%excess)) .and. &
         size(field%offset) == size(other%offset)
   end function fits

   !> Read a number of entries
   subroutine read_count(reader, n)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The number; none if anything is wrong
      integer, intent(out) :: n

      call reader%get(n)
      if (n < 0) reader%failed = .true.
      if (reader%failed) n = 0
   end subroutine read_count

   !> Write the loads of a step
   subroutine write_step(step, writer)
      !> The step
      type(step_type), intent(in) :: step
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      call writer%put(step%load_factor)
      call writer%put(step%case_factor)
      call writer%put(step%share)
      call writer%put(allocated(step%steered))
      if (allocated(step%steered)) call writer%put(step%steered)
   end subroutine write_step

   !> Read the loads of a step
   subroutine read_step(reader, step)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The step
      type(step_type), intent(out) :: step

      logical :: steered

      call reader%get(step%load_factor)
      call reader%get(step%case_factor)
      call reader%get(step%share)
      call reader%get(steered)
      if (steered) call reader%get(step%steered)
   end subroutine read_step

   !> Write when the last step ended
   subroutine write_control(control, writer)
      !> The control
      type(control_type), intent(in) :: control
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      call writer%put(control%tolerance)
      call writer%put(control%most)
      call writer%put(control%warm)
      call write_path([control%now], writer)
   end subroutine write_control

   !> Read when the last step ended
   subroutine read_control(reader, control)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The control
      type(control_type), intent(out) :: control

      type(iteration_type), allocatable :: now(:)

      call reader%get(control%tolerance)
      call reader%get(control%most)
      call reader%get(control%warm)
      call read_path(reader, now)
      if (size(now) == 1) control%now = now(1)
   end subroutine read_control

   !> Write what the loads do to the condensed structure
   subroutine write_loads(loads, writer)
      !> The loads
      type(joint_loads_type), intent(in) :: loads
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      call writer%put(loads%free)
      call writer%put(loads%largest)
      call writer%put(loads%work)
      call writer%put(loads%size)
      call writer%put(loads%stress)
      call writer%put(loads%reference%loads)
      call writer%put(loads%reference%forces)
   end subroutine write_loads

   !> Read what the loads do to the condensed structure
   subroutine read_loads(reader, loads)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The loads
      type(joint_loads_type), intent(inout) :: loads

      call reader%get(loads%free)
      call reader%get(loads%largest)
      call reader%get(loads%work)
      call reader%get(loads%size)
      call reader%get(loads%stress)
      call reader%get(loads%reference%loads)
      call reader%get(loads%reference%forces)
   end subroutine read_loads

   !> Write the state of the joints
   subroutine write_field(field, writer)
      !> The state
      type(joint_field_type), intent(in) :: field
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      call writer%put(field%jump)
      call writer%put(field%stress)
      call writer%put(field%state)
      call write_memory(field%memory, writer)
      call writer%put(field%initial)
      call writer%put(field%in_situ)
      call writer%put(field%share)
      call writer%put(field%view_limit)
      call writer%put(field%fading)
      call writer%put(field%excess)
      call writer%put(field%pending)
      call writer%put(field%offset)
      call writer%put(field%moved)
      call writer%put(field%carried)
   end subroutine write_field

   !> Read the state of the joints
   subroutine read_field(reader, field)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The state
      type(joint_field_type), intent(out) :: field

      call reader%get(field%jump)
      call reader%get(field%stress)
      call reader%get(field%state)
      call read_memory(reader, field%memory)
      call reader%get(field%initial)
      call reader%get(field%in_situ)
      call reader%get(field%share)
      call reader%get(field%view_limit)
      call reader%get(field%fading)
      call reader%get(field%excess)
      call reader%get(field%pending)
      call reader%get(field%offset)
      call reader%get(field%moved)
      call reader%get(field%carried)
   end subroutine read_field

   !> Write what points remember
   subroutine write_memory(memory, writer)
      !> The memory, shape (points, planes)
      type(memory_type), intent(in), allocatable :: memory(:, :)
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      real(wp), allocatable :: slip(:, :, :)
      logical, allocatable :: broken(:, :), softened(:, :)
      integer :: k

      if (allocated(memory)) then
         allocate (slip(3, size(memory, 1), size(memory, 2)))
         do k = 1, 3
            slip(k, :, :) = memory%slip(k)
         end do
         broken = memory%broken
         softened = memory%softened
      end if
      call writer%put(slip)
      call writer%put(broken)
      call writer%put(softened)
   end subroutine write_memory

   !> Read what points remember
   subroutine read_memory(reader, memory)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The memory
      type(memory_type), intent(out), allocatable :: memory(:, :)

      real(wp), allocatable :: slip(:, :, :)
      logical, allocatable :: broken(:, :), softened(:, :)
      integer :: k

      call reader%get(slip)
      call reader%get(broken)
      call reader%get(softened)
      if (reader%failed .or. .not. allocated(slip)) return
      allocate (memory(size(slip, 2), size(slip, 3)))
      do k = 1, 3
         memory%slip(k) = slip(k, :, :)
      end do
      memory%broken = broken
      memory%softened = softened
   end subroutine read_memory

   !> Write how the last step ended
   subroutine write_verdict(verdict, writer)
      !> The verdict
      type(verdict_type), intent(in) :: verdict
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      logical, allocatable :: stands(:, :)

      call writer%put(verdict%converged)
      call writer%put(verdict%stalled)
      call writer%put(verdict%at_rounding)
      call writer%put(verdict%ran_away)
      call writer%put(verdict%mechanism%loaded)
      call writer%put(verdict%mechanism%motion)
      call writer%put(verdict%mechanism%idle)
      if (allocated(verdict%mechanism%stands)) stands = reshape(verdict%mechanism%stands, [size(verdict%mechanism%stands), 1])
      call writer%put(stands)
      call writer%put(verdict%restless)
      call writer%put(verdict%n_passes)
      call writer%put(verdict%residual%ratio)
      call writer%put(verdict%residual%whole)
      call writer%put(verdict%residual%node)
      call writer%put(verdict%residual%mode)
   end subroutine write_verdict

   !> Read how the last step ended
   subroutine read_verdict(reader, verdict)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The verdict
      type(verdict_type), intent(out) :: verdict

      logical, allocatable :: stands(:, :)

      call reader%get(verdict%converged)
      call reader%get(verdict%stalled)
      call reader%get(verdict%at_rounding)
      call reader%get(verdict%ran_away)
      call reader%get(verdict%mechanism%loaded)
      call reader%get(verdict%mechanism%motion)
      call reader%get(verdict%mechanism%idle)
      call reader%get(stands)
      if (allocated(stands)) verdict%mechanism%stands = stands(:, 1)
      call reader%get(verdict%restless)
      call reader%get(verdict%n_passes)
      call reader%get(verdict%residual%ratio)
      call reader%get(verdict%residual%whole)
      call reader%get(verdict%residual%node)
      call reader%get(verdict%residual%mode)
   end subroutine read_verdict

   !> Write lines of a convergence path
   subroutine write_path(path, writer)
      !> The lines
      type(iteration_type), intent(in) :: path(:)
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      integer, allocatable :: counts(:, :)
      real(wp), allocatable :: values(:, :)
      integer :: k

      allocate (counts(4, size(path)), values(2, size(path)))
      do k = 1, size(path)
         counts(:, k) = [path(k)%increment, path(k)%iteration, path(k)%n_slip, path(k)%n_open]
         values(:, k) = [path(k)%load_factor, path(k)%ratio]
      end do
      call writer%put(counts)
      call writer%put(values)
   end subroutine write_path

   !> Read lines of a convergence path
   subroutine read_path(reader, path)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The lines
      type(iteration_type), intent(out), allocatable :: path(:)

      integer, allocatable :: counts(:, :)
      real(wp), allocatable :: values(:, :)
      integer :: k

      call reader%get(counts)
      call reader%get(values)
      if (reader%failed) then
         allocate (path(0))
         return
      end if
      allocate (path(size(counts, 2)))
      do k = 1, size(path)
         path(k) = iteration_type(counts(1, k), counts(2, k), values(1, k), values(2, k), &
                                  counts(3, k), counts(4, k))
      end do
   end subroutine read_path

   !> Write the end of an increment
   subroutine write_state(state, writer)
      !> The state
      type(increment_state_type), intent(in) :: state
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      call writer%put(state%increment)
      call writer%put(state%load_factor)
      call writer%put(state%case_factor)
      call writer%put(state%peak_factor)
      call writer%put(state%jump)
      call writer%put(state%stress)
      call writer%put(state%state)
      call writer%put(state%excess)
      call writer%put(state%pending)
      call writer%put(state%initial)
      call writer%put(state%offset)
      call write_bodies(state%bodies, writer)
   end subroutine write_state

   !> Read the end of an increment
   subroutine read_state(reader, state)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The state
      type(increment_state_type), intent(out) :: state

      call reader%get(state%increment)
      call reader%get(state%load_factor)
      call reader%get(state%case_factor)
      call reader%get(state%peak_factor)
      call reader%get(state%jump)
      call reader%get(state%stress)
      call reader%get(state%state)
      call reader%get(state%excess)
      call reader%get(state%pending)
      call reader%get(state%initial)
      call reader%get(state%offset)
      call read_bodies(reader, state%bodies)
   end subroutine read_state

   !> Write bodies that yield at the end of an increment
   subroutine write_bodies(bodies, writer)
      !> Their state
      type(plastic_state_type), intent(in) :: bodies
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      integer, allocatable :: place(:, :)

      if (allocated(bodies%place)) place = reshape(bodies%place, [size(bodies%place), 1])
      call writer%put(place)
      call writer%put(bodies%taken)
      call writer%put(bodies%gained)
      call writer%put(bodies%amplitude)
      call writer%put(bodies%carried)
      call writer%put(bodies%dissipated)
      call writer%put(bodies%dissipation)
      call writer%put(bodies%iterations)
      call writer%put(bodies%solutions)
      call writer%put(bodies%on_planes)
      call writer%put(bodies%n_yielding)
   end subroutine write_bodies

   !> Read bodies that yield at the end of an increment
   subroutine read_bodies(reader, bodies)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> Their state
      type(plastic_state_type), intent(out) :: bodies

      integer, allocatable :: place(:, :)

      call reader%get(place)
      if (allocated(place)) bodies%place = reshape(place, [size(place)])
      call reader%get(bodies%taken)
      call reader%get(bodies%gained)
      call reader%get(bodies%amplitude)
      call reader%get(bodies%carried)
      call reader%get(bodies%dissipated)
      call reader%get(bodies%dissipation)
      call reader%get(bodies%iterations)
      call reader%get(bodies%solutions)
      call reader%get(bodies%on_planes)
      call reader%get(bodies%n_yielding)
   end subroutine read_bodies

   !> Write what a step left out of balance
   subroutine write_residual(record, writer)
      !> The record
      type(residual_record_type), intent(in) :: record
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      call writer%put(record%increment)
      call writer%put(record%load_factor)
      call writer%put(record%whole)
      call writer%put(record%ratio)
   end subroutine write_residual

   !> Read what a step left out of balance
   subroutine read_residual(reader, record)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The record
      type(residual_record_type), intent(out) :: record

      call reader%get(record%increment)
      call reader%get(record%load_factor)
      call reader%get(record%whole)
      call reader%get(record%ratio)
   end subroutine read_residual

end module axijoint_joints_history_record
