!> State of bodies that yield as it is kept: what is shown of an increment, and all of it as bytes
module axijoint_plastic_record
   use axijoint_base_kinds, only : wp
   use axijoint_base_stream, only : writer_type, reader_type, new_reader
   use axijoint_joints_planes, only : planes_type, analyse
   use axijoint_joints_states, only : plastic_state_type
   use axijoint_plastic_bodies, only : bodies_type
   use axijoint_plastic_field, only : body_field_type
   implicit none
   private
   public :: snapshot, on_all_points, bytes_of, read_bytes

contains

   !> What is kept of an increment in equilibrium
   function snapshot(bodies, planes, field) result(state)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The state, committed
      type(body_field_type), intent(in) :: field
      !> What is kept
      type(plastic_state_type) :: state

      integer, allocatable :: points(:)
      integer :: i

      points = pack([(i, i=1, size(field%marked))], field%marked)
      state%place = bodies%place(points)
      state%taken = field%taken(:, points, :)
      state%gained = field%gained(points, :)
      state%carried = field%carried(:, points, :)
      state%amplitude = analyse(planes, state%taken)
      state%dissipated = field%dissipated
      state%dissipation = field%dissipation(points, :)
   end function snapshot

   !> Amplitudes of some points as those of all Gauss points
   pure function on_all_points(place, amplitude, n) result(all)
      !> Place of each among all
      integer, intent(in) :: place(:)
      !> Amplitudes, shape (6, points, modes)
      real(wp), intent(in) :: amplitude(:, :, :)
      !> Number of Gauss points of all elements
      integer, intent(in) :: n
      !> The same; zero elsewhere, shape (6, n, modes)
      real(wp), allocatable :: all(:, :, :)

      allocate (all(6, n, size(amplitude, 3)), source=0.0_wp)
      all(:, place, :) = amplitude
   end function on_all_points

   !> All that the next step starts from
   function bytes_of(field, counts) result(bytes)
      !> The state, committed
      type(body_field_type), intent(in) :: field
      !> Iterations and elastic solutions of the increment at work
      integer, intent(in) :: counts(2)
      !> The bytes
      character(len=:), allocatable :: bytes

      type(writer_type) :: writer
      logical, allocatable :: marked(:, :)

      marked = reshape(field%marked, [size(field%marked), 1])
      call writer%put(field%begun)
      call writer%put(field%moved)
      call writer%put(field%right)
      call writer%put(field%pushed)
      call writer%put(field%taken)
      call writer%put(field%gained)
      call writer%put(field%carried)
      call writer%put(field%elastic_before)
      call writer%put(field%force_before)
      call writer%put(marked)
      call writer%put(field%scale)
      call writer%put(field%dissipated)
      call writer%put(field%dissipation)
      call writer%put(field%begins)
      call writer%put(field%goes_down)
      call writer%put(counts(1))
      call writer%put(counts(2))
      call writer%give(bytes)
   end function bytes_of

   !> Go back to a state; `fits` is false if it is of other bodies
   subroutine read_bytes(bytes, field, counts, fits)
      !> The bytes
      character(len=*), intent(in) :: bytes
      !> The state, new
      type(body_field_type), intent(inout) :: field
      !> Iterations and elastic solutions of the increment at work
      integer, intent(out) :: counts(2)
      !> Whether they are of such a state
      logical, intent(out) :: fits

      type(reader_type) :: reader
      logical, allocatable :: marked(:, :)
      integer :: taken(3), n

      taken = shape(field%taken)
      n = size(field%begun)
      reader = new_reader(bytes)
      call reader%get(field%begun)
      call reader%get(field%moved)
      call reader%get(field%right)
      call reader%get(field%pushed)
      call reader%get(field%taken)
      call reader%get(field%gained)
      call reader%get(field%carried)
      call reader%get(field%elastic_before)
      call reader%get(field%force_before)
      call reader%get(marked)
      call reader%get(field%scale)
      call reader%get(field%dissipated)
      call reader%get(field%dissipation)
      call reader%get(field%begins)
      call reader%get(field%goes_down)
      call reader%get(counts(1))
      call reader%get(counts(2))
      fits = .not. reader%failed .and. reader%at_end()
      if (.not. fits) return
      fits = all(shape(field%taken) == taken) .and. size(field%begun) == n
      if (.not. fits) return
      field%marked = reshape(marked, [size(marked)])
      field%unknowns = field%begun
   end subroutine read_bytes

end module axijoint_plastic_record
