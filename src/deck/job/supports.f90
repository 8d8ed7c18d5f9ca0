!> Faces that cards hold, so that their reactions are listed
module axijoint_deck_job_supports
   use axijoint_base_number_map, only : find_number
   use axijoint_deck_job_deck, only : deck_type
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_text_table, only : table_type, integer_value
   use axijoint_model_request, only : supported_face_type
   implicit none
   private
   public :: gather_supported_faces

contains

   !> Faces that the sections of supports name, each once, with the nodes that no face before it has
   pure function gather_supported_faces(deck) result(faces)
      !> The deck
      type(deck_type), intent(in) :: deck
      !> The faces
      type(supported_face_type), allocatable :: faces(:)

      logical, allocatable :: known(:)
      integer :: k, field

      allocate (faces(0))
      allocate (known(deck%draft%n_nodes), source=.false.)
      do k = 1, size(deck%sections%tables)
         if (.not. deck%source%sections(k)%is_support) cycle
         associate (table => deck%sections%tables(k))
            do field = 1, size(table%fields)
               if (table%fields(field)%refers_to == 'face') call gather(table, field, deck%draft, &
                  known, faces)
            end do
         end associate
      end do
   end function gather_supported_faces

   !> Faces that a field of a section names
   pure subroutine gather(table, field, draft, known, faces)
      !> The section
      type(table_type), intent(in) :: table
      !> The field
      integer, intent(in) :: field
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Whether a face has a node already
      logical, intent(inout) :: known(:)
      !> The faces; grows
      type(supported_face_type), allocatable, intent(inout) :: faces(:)

      logical, allocatable :: new(:)
      integer :: entry, face, i

      allocate (new(size(known)))
      do entry = 1, table%n
         if (.not. table%good(entry)) cycle
         face = find_number(draft%face_of, integer_value(table, field, entry))
         if (face == 0) cycle
         if (.not. draft%faces(face)%good .or. any(faces%label == draft%faces(face)%label)) cycle
         faces = [faces, supported_face_type(draft%faces(face)%label, [integer ::])]
         new = .false.
         do i = 1, size(draft%faces(face)%edges)
            associate (nodes => draft%faces(face)%edges(i)%nodes)
               new(nodes(:count(nodes > 0))) = .true.
            end associate
         end do
         faces(size(faces))%nodes = pack([(i, i=1, size(new))], new .and. .not. known)
         known = known .or. new
      end do
   end subroutine gather

end module axijoint_deck_job_supports
