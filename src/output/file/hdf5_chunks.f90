!> How an array is cut in an HDF5 file, and what it takes there
module axijoint_output_file_hdf5_chunks
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: stored_bytes, chunk_extent, small_array

   !> Values of a chunk at most; about a megabyte of reals
   integer(i8), parameter :: chunk_values = 131072_i8
   !> How many times as many chunks as are needed may be made, where that leaves less room unused by this share of the array
   integer(i8), parameter :: most_parts = 4_i8, least_gain = 16_i8
   !> Bytes of an array that stands in a header at most; the format allows 64 KiB
   integer(i8), parameter :: small_array = 16384_i8

contains

   !> Bytes of an array in a file, without its header
   pure real(wp) function stored_bytes(bytes, extent)
      !> Bytes of a value
      integer, intent(in) :: bytes
      !> Extents of the array
      integer(i8), intent(in) :: extent(:)

      integer(i8), dimension(size(extent)) :: chunk

      stored_bytes = bytes*product(real(extent, wp))
      if (stored_bytes <= small_array) return
      chunk = chunk_extent(extent)
      stored_bytes = bytes*product(real(chunk*parts(extent, chunk), wp))
   end function stored_bytes

   !> Extents of a chunk: whole leading indices up to `chunk_values` values, an index that does not fit cut into parts that
   !> leave as little room as may be beyond its end, as each chunk takes its room whole
   pure function chunk_extent(extent) result(chunk)
      !> Extents of the array, all positive
      integer(i8), intent(in) :: extent(:)
      !> Extents of a chunk
      integer(i8) :: chunk(size(extent))

      integer(i8) :: room, n, least
      integer :: i

      room = chunk_values
      do i = 1, size(extent)
         least = parts(extent(i), max(1_i8, room))
         chunk(i) = parts(extent(i), least)
         do n = least + 1, min(extent(i), most_parts*least)
            associate (part => parts(extent(i), n))
               if (least_gain*(chunk(i)*parts(extent(i), chunk(i)) - part*parts(extent(i), part)) > extent(i)) chunk(i) = part
            end associate
         end do
         room = room/chunk(i)
      end do
   end function chunk_extent

   !> Parts of a length at most that a whole is cut into
   elemental integer(i8) function parts(whole, longest)
      !> The whole, and the longest part
      integer(i8), intent(in) :: whole, longest

      parts = (whole + longest - 1)/longest
   end function parts

end module axijoint_output_file_hdf5_chunks
