!> Values one after the other in a row of bytes, as they lie in memory: what is read is what was
!> written, bit for bit. Arrays carry their shape, and whether they are allocated
module axijoint_base_stream
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: writer_type, reader_type, new_reader

   !> Bytes of an integer, of a long one, of a real
   integer, parameter :: integer_bytes = storage_size(0)/8, long_bytes = storage_size(0_i8)/8, &
      real_bytes = storage_size(0.0_wp)/8

   !> Bytes that are being written
   type :: writer_type
      private
      character(len=:), allocatable :: room
      integer(i8) :: used = 0
   contains
      !> Append a number, a truth, a text, an array
      generic :: put => put_integer, put_long, put_real, put_logical, put_text, put_integers_2, &
         put_logicals_2, put_reals_1, put_reals_2, put_reals_3
      procedure, private :: put_integer, put_long, put_real, put_logical, put_text, &
         put_integers_2, put_logicals_2, put_reals_1, put_reals_2, put_reals_3
      !> Make room for so many bytes, so that none are copied as it grows
      procedure :: reserve
      !> Give all away that was written: there is no copy where the room is filled
      procedure :: give
      procedure, private :: add, put_shape
   end type writer_type

   !> Bytes that are being read
   type :: reader_type
      private
      character(len=:), allocatable :: bytes
      integer(i8) :: used = 0
      !> Whether they ended too soon, or are not of what was asked for
      logical, public :: failed = .false.
   contains
      !> Take the next number, truth, text, array
      generic :: get => get_integer, get_long, get_real, get_logical, get_text, get_integers_2, &
         get_logicals_2, get_reals_1, get_reals_2, get_reals_3
      procedure, private :: get_integer, get_long, get_real, get_logical, get_text, &
         get_integers_2, get_logicals_2, get_reals_1, get_reals_2, get_reals_3
      !> Whether all was read
      procedure :: at_end
      procedure, private :: take, get_shape
   end type reader_type

contains

   !> Read bytes
   function new_reader(bytes) result(reader)
      !> The bytes
      character(len=*), intent(in) :: bytes
      !> At their beginning
      type(reader_type) :: reader

      reader%bytes = bytes
   end function new_reader

   !> Make room for so many bytes, so that none are copied as it grows
   subroutine reserve(self, n)
      !> The writer, new
      class(writer_type), intent(inout) :: self
      !> How many
      integer(i8), intent(in) :: n

      if (.not. allocated(self%room)) allocate (character(len=n) :: self%room)
   end subroutine reserve

   !> Give all away that was written
   subroutine give(self, bytes)
      !> The writer; new on return
      class(writer_type), intent(inout) :: self
      !> The bytes
      character(len=:), allocatable, intent(out) :: bytes

      if (.not. allocated(self%room)) allocate (character(len=0) :: self%room)
      if (self%used < len(self%room, i8)) then
         bytes = self%room(:self%used)
         deallocate (self%room)
      else
         call move_alloc(self%room, bytes)
      end if
      self%used = 0
   end subroutine give

   !> Append bytes
   subroutine add(self, piece)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The bytes
      character(len=*), intent(in) :: piece

      call make_room(self, len(piece, i8))
      self%room(self%used + 1:self%used + len(piece, i8)) = piece
      self%used = self%used + len(piece, i8)
   end subroutine add

   !> Append the bytes of reals, some at a time: of all at once there would be copies
   subroutine add_reals(writer, n, values)
      !> The writer
      class(writer_type), intent(inout) :: writer
      !> How many
      integer(i8), intent(in) :: n
      !> The reals
      real(wp), intent(in) :: values(n)

      integer(i8), parameter :: at_once = 512
      character(len=at_once*real_bytes) :: piece
      integer(i8) :: i, last

      call make_room(writer, n*real_bytes)
      do i = 1, n, at_once
         last = min(n, i + at_once - 1)
         piece = transfer(values(i:last), piece)
         call writer%add(piece(:real_bytes*(last - i + 1)))
      end do
   end subroutine add_reals

   !> Make room for more bytes; it grows by doubling
   subroutine make_room(writer, n)
      !> The writer
      class(writer_type), intent(inout) :: writer
      !> How many more
      integer(i8), intent(in) :: n

      character(len=:), allocatable :: larger
      integer(i8) :: needed

      if (.not. allocated(writer%room)) allocate (character(len=4096) :: writer%room)
      needed = writer%used + n
      if (needed <= len(writer%room, i8)) return
      allocate (character(len=2*needed) :: larger)
      larger(:writer%used) = writer%room(:writer%used)
      call move_alloc(larger, writer%room)
   end subroutine make_room

   !> Take bytes; zeros if there are too few
   function take(self, count) result(piece)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> How many
      integer(i8), intent(in) :: count
      !> The bytes
      character(len=:), allocatable :: piece

      self%failed = self%failed .or. count < 0 .or. count > len(self%bytes, i8) - self%used
      if (self%failed) then
         piece = repeat(achar(0), int(min(max(count, 0_i8), 8_i8)))
         return
      end if
      piece = self%bytes(self%used + 1:self%used + count)
      self%used = self%used + count
   end function take

   !> Whether all was read, and nothing failed
   pure logical function at_end(self)
      !> The reader
      class(reader_type), intent(in) :: self

      at_end = .not. self%failed .and. self%used == len(self%bytes, i8)
   end function at_end

   !> Append the shape of an array; -1 for one that is not allocated
   subroutine put_shape(self, there, extents)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> Whether the array is allocated
      logical, intent(in) :: there
      !> Its extents
      integer, intent(in) :: extents(:)

      integer :: k

      call self%put(merge(size(extents), -1, there))
      if (.not. there) return
      do k = 1, size(extents)
         call self%put(extents(k))
      end do
   end subroutine put_shape

   !> Take the shape of an array
   subroutine get_shape(self, width, there, extents)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> Bytes of an element
      integer, intent(in) :: width
      !> Whether the array is allocated
      logical, intent(out) :: there
      !> Its extents; zero if anything is wrong
      integer, intent(out) :: extents(:)

      integer :: k, rank

      extents = 0
      call self%get(rank)
      there = rank >= 0 .and. .not. self%failed
      if (.not. there) return
      self%failed = rank /= size(extents)
      do k = 1, size(extents)
         call self%get(extents(k))
      end do
      if (any(extents < 0) .or. width*product(real(extents, wp)) > real(len(self%bytes, i8), wp)) &
         self%failed = .true.
      if (self%failed) extents = 0
   end subroutine get_shape

   !> Append a number
   subroutine put_integer(self, value)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The value
      integer, intent(in) :: value

      call self%add(transfer(value, repeat(' ', integer_bytes)))
   end subroutine put_integer

   !> Take a number
   subroutine get_integer(self, value)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The value
      integer, intent(out) :: value

      value = transfer(self%take(int(integer_bytes, i8)), value)
   end subroutine get_integer

   !> Append a long number
   subroutine put_long(self, value)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The value
      integer(i8), intent(in) :: value

      call self%add(transfer(value, repeat(' ', long_bytes)))
   end subroutine put_long

   !> Take a long number
   subroutine get_long(self, value)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The value
      integer(i8), intent(out) :: value

      value = transfer(self%take(int(long_bytes, i8)), value)
   end subroutine get_long

   !> Append a real
   subroutine put_real(self, value)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The value
      real(wp), intent(in) :: value

      call self%add(transfer(value, repeat(' ', real_bytes)))
   end subroutine put_real

   !> Take a real
   subroutine get_real(self, value)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The value
      real(wp), intent(out) :: value

      value = transfer(self%take(int(real_bytes, i8)), value)
   end subroutine get_real

   !> Append a truth
   subroutine put_logical(self, value)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The value
      logical, intent(in) :: value

      call self%put(merge(1, 0, value))
   end subroutine put_logical

   !> Take a truth
   subroutine get_logical(self, value)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The value
      logical, intent(out) :: value

      integer :: number

      call self%get(number)
      value = number == 1
      if (number /= 0 .and. number /= 1) self%failed = .true.
   end subroutine get_logical

   !> Append a text
   subroutine put_text(self, text)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The text
      character(len=*), intent(in) :: text

      call self%put(len(text, i8))
      call self%add(text)
   end subroutine put_text

   !> Take a text
   subroutine get_text(self, text)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The text
      character(len=:), allocatable, intent(out) :: text

      integer(i8) :: length

      call self%get(length)
      text = self%take(length)
      if (self%failed) text = ''
   end subroutine get_text

   !> Append an array of numbers
   subroutine put_integers_2(self, values)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The values
      integer, intent(in), allocatable :: values(:, :)

      if (.not. allocated(values)) then
         call self%put_shape(.false., [0, 0])
         return
      end if
      call self%put_shape(.true., shape(values))
      call self%add(transfer(values, repeat(' ', integer_bytes*size(values))))
   end subroutine put_integers_2

   !> Take an array of numbers
   subroutine get_integers_2(self, values)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The values
      integer, intent(out), allocatable :: values(:, :)

      integer :: n(2)
      logical :: there

      call self%get_shape(integer_bytes, there, n)
      if (.not. there) return
      allocate (values(n(1), n(2)), source=0)
      if (size(values) > 0) values = reshape(transfer(self%take(int(integer_bytes, i8)* &
         size(values, kind=i8)), [0], size(values)), n)
   end subroutine get_integers_2

   !> Append an array of truths
   subroutine put_logicals_2(self, values)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The values
      logical, intent(in), allocatable :: values(:, :)

      integer, allocatable :: numbers(:, :)

      if (allocated(values)) numbers = merge(1, 0, values)
      call self%put(numbers)
   end subroutine put_logicals_2

   !> Take an array of truths
   subroutine get_logicals_2(self, values)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The values
      logical, intent(out), allocatable :: values(:, :)

      integer, allocatable :: numbers(:, :)

      call self%get(numbers)
      if (allocated(numbers)) values = numbers == 1
   end subroutine get_logicals_2

   !> Append an array of reals
   subroutine put_reals_1(self, values)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The values
      real(wp), intent(in), allocatable :: values(:)

      if (.not. allocated(values)) then
         call self%put_shape(.false., [0])
         return
      end if
      call self%put_shape(.true., shape(values))
      call add_reals(self, size(values, kind=i8), values)
   end subroutine put_reals_1

   !> Take an array of reals
   subroutine get_reals_1(self, values)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The values
      real(wp), intent(out), allocatable :: values(:)

      integer :: n(1)
      logical :: there

      call self%get_shape(real_bytes, there, n)
      if (.not. there) return
      allocate (values(n(1)), source=0.0_wp)
      if (size(values) > 0) values = transfer(self%take(int(real_bytes, i8)* &
         size(values, kind=i8)), [0.0_wp], size(values))
   end subroutine get_reals_1

   !> Append an array of reals
   subroutine put_reals_2(self, values)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The values
      real(wp), intent(in), allocatable :: values(:, :)

      if (.not. allocated(values)) then
         call self%put_shape(.false., [0, 0])
         return
      end if
      call self%put_shape(.true., shape(values))
      call add_reals(self, size(values, kind=i8), values)
   end subroutine put_reals_2

   !> Take an array of reals
   subroutine get_reals_2(self, values)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The values
      real(wp), intent(out), allocatable :: values(:, :)

      integer :: n(2)
      logical :: there

      call self%get_shape(real_bytes, there, n)
      if (.not. there) return
      allocate (values(n(1), n(2)), source=0.0_wp)
      if (size(values) > 0) values = reshape(transfer(self%take(int(real_bytes, i8)* &
         size(values, kind=i8)), [0.0_wp], size(values)), n)
   end subroutine get_reals_2

   !> Append an array of reals
   subroutine put_reals_3(self, values)
      !> The writer
      class(writer_type), intent(inout) :: self
      !> The values
      real(wp), intent(in), allocatable :: values(:, :, :)

      if (.not. allocated(values)) then
         call self%put_shape(.false., [0, 0, 0])
         return
      end if
      call self%put_shape(.true., shape(values))
      call add_reals(self, size(values, kind=i8), values)
   end subroutine put_reals_3

   !> Take an array of reals
   subroutine get_reals_3(self, values)
      !> The reader
      class(reader_type), intent(inout) :: self
      !> The values
      real(wp), intent(out), allocatable :: values(:, :, :)

      integer :: n(3)
      logical :: there

      call self%get_shape(real_bytes, there, n)
      if (.not. there) return
      allocate (values(n(1), n(2), n(3)), source=0.0_wp)
      if (size(values) > 0) values = reshape(transfer(self%take(int(real_bytes, i8)* &
         size(values, kind=i8)), [0.0_wp], size(values)), n)
   end subroutine get_reals_3

end module axijoint_base_stream
