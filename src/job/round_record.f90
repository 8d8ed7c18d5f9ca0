!> What a round of refinement starts from, as bytes and back
module axijoint_job_round_record
   use axijoint_analysis_core_results, only : round_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_stream, only : writer_type, reader_type, new_reader
   use axijoint_model_request, only : refinement_type
   implicit none
   private
   public :: round_bytes, restore_round

contains

   !> What a round starts from, as bytes
   function round_bytes(rounds, refinement, before, back) result(bytes)
      !> What earlier rounds came to
      type(round_type), intent(in) :: rounds(:)
      !> Refinement of this one, and of the one before
      type(refinement_type), intent(in) :: refinement, before
      !> Whether this one goes back to the one before
      logical, intent(in) :: back
      !> The bytes
      character(len=:), allocatable :: bytes

      type(writer_type) :: writer
      integer :: k

      call writer%put(back)
      call put_refinement(refinement, writer)
      call put_refinement(before, writer)
      call writer%put(size(rounds))
      do k = 1, size(rounds)
         associate (round => rounds(k))
            call writer%put(round%mesh)
            call writer%put(round%nodes)
            call writer%put(round%harmonic)
            call writer%put(round%planes)
            call writer%put(round%n_unknowns)
            call writer%put(round%error)
            call writer%put(round%seconds)
            call writer%put(allocated(round%failure))
            if (allocated(round%failure)) call writer%put(round%failure)
         end associate
      end do
      call writer%give(bytes)
   end function round_bytes

   !> Bring a round back; nothing changes if there are no bytes
   subroutine restore_round(bytes, rounds, refinement, before, back)
      !> The bytes
      character(len=*), intent(in) :: bytes
      !> What earlier rounds came to
      type(round_type), allocatable, intent(inout) :: rounds(:)
      !> Refinement of this one, and of the one before
      type(refinement_type), intent(inout) :: refinement, before
      !> Whether this one goes back to the one before
      logical, intent(inout) :: back

      type(reader_type) :: reader
      integer :: k, n
      logical :: failed

      if (len(bytes) == 0) return
      reader = new_reader(bytes)
      call reader%get(back)
      call get_refinement(reader, refinement)
      call get_refinement(reader, before)
      call reader%get(n)
      deallocate (rounds)
      allocate (rounds(n))
      do k = 1, n
         associate (round => rounds(k))
            call reader%get(round%mesh)
            call reader%get(round%nodes)
            call reader%get(round%harmonic)
            call reader%get(round%planes)
            call reader%get(round%n_unknowns)
            call reader%get(round%error)
            call reader%get(round%seconds)
            call reader%get(failed)
            if (failed) call reader%get(round%failure)
         end associate
      end do
   end subroutine restore_round

   !> Write a refinement
   subroutine put_refinement(refinement, writer)
      !> The refinement
      type(refinement_type), intent(in) :: refinement
      !> Takes the bytes
      type(writer_type), intent(inout) :: writer

      real(wp), allocatable :: line(:, :)
      integer :: k

      call writer%put(refinement%mesh)
      call writer%put(refinement%quadratic)
      call writer%put(refinement%newton)
      call writer%put(refinement%harmonic)
      call writer%put(refinement%planes)
      call writer%put(refinement%tolerance)
      call writer%put(allocated(refinement%mesh_file))
      if (allocated(refinement%mesh_file)) then
         call writer%put(refinement%mesh_file)
         call writer%put(refinement%mesh_hash)
      end if
      call writer%put(allocated(refinement%strips))
      if (.not. allocated(refinement%strips)) return
      call writer%put(size(refinement%strips))
      do k = 1, size(refinement%strips)
         call writer%put(refinement%strips(k)%ends)
         line = refinement%strips(k)%line
         call writer%put(line)
      end do
   end subroutine put_refinement

   !> Read a refinement
   subroutine get_refinement(reader, refinement)
      !> The bytes
      type(reader_type), intent(inout) :: reader
      !> The refinement
      type(refinement_type), intent(out) :: refinement

      real(wp), allocatable :: line(:, :)
      logical :: graded, remade
      integer :: k, n

      call reader%get(refinement%mesh)
      call reader%get(refinement%quadratic)
      call reader%get(refinement%newton)
      call reader%get(refinement%harmonic)
      call reader%get(refinement%planes)
      call reader%get(refinement%tolerance)
      call reader%get(remade)
      if (remade) then
         call reader%get(refinement%mesh_file)
         call reader%get(refinement%mesh_hash)
      end if
      call reader%get(graded)
      if (.not. graded) return
      call reader%get(n)
      allocate (refinement%strips(n))
      do k = 1, n
         call reader%get(refinement%strips(k)%ends)
         call reader%get(line)
         refinement%strips(k)%line = line
      end do
   end subroutine get_refinement

end module axijoint_job_round_record
