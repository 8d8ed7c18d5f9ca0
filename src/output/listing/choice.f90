!> Which rows of its long tables the listing shows: all of those that are not too long, or those
!> that PRINT asks for
module axijoint_output_listing_choice
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, count_of
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : print_type, cards_about, print_nodes, print_elements, &
      print_joints, print_amplitude, print_totals, print_stresses, print_nodal, print_states, &
      print_reactions, rows_all, rows_every, rows_upto
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: chosen_places, chosen_lines, none_asked, write_left

contains

   !> Rows of a table of places that are listed, shape (rows)
   pure function chosen_places(model, results, what, n_lines, there) result(listed)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> The table, one of the `print_` parameters
      integer, intent(in) :: what
      !> Lines of a row; 1 if absent
      integer, intent(in), optional :: n_lines
      !> Rows that there are; all if absent
      logical, intent(in), optional :: there(:)
      !> Whether a row is listed
      logical, allocatable :: listed(:)

      type(print_type), allocatable :: cards(:)
      logical, allocatable :: inside(:)
      integer :: k, lines

      lines = 1
      if (present(n_lines)) lines = n_lines
      cards = cards_about(model%print, what)
      do k = 1, size(cards)
         inside = is_inside(model, results, what, cards(k))
         if (present(there)) inside = inside .and. there
         call thin(cards(k), lines, inside)
         if (k == 1) then
            call move_alloc(inside, listed)
         else
            listed = listed .or. inside
         end if
      end do
   end function chosen_places

   !> Rows of a table without places that are listed, shape (n)
   pure function chosen_lines(model, what, n) result(listed)
      !> The job
      type(model_type), intent(in) :: model
      !> The table, one of the `print_` parameters
      integer, intent(in) :: what
      !> Its rows
      integer, intent(in) :: n
      !> Whether a row is listed
      logical, allocatable :: listed(:)

      type(print_type), allocatable :: cards(:)
      logical, allocatable :: inside(:)
      integer :: k

      cards = cards_about(model%print, what)
      allocate (listed(n), source=.false.)
      do k = 1, size(cards)
         allocate (inside(n), source=.true.)
         call thin(cards(k), 1, inside)
         listed = listed .or. inside
         deallocate (inside)
      end do
   end function chosen_lines

   !> Whether the deck asks for no row of a table: then nothing is said of it
   pure logical function none_asked(model, what) result(none)
      !> The job
      type(model_type), intent(in) :: model
      !> The table, one of the `print_` parameters
      integer, intent(in) :: what

      type(print_type), allocatable :: cards(:)

      cards = cards_about(model%print, what)
      none = .not. any(cards%which == rows_all .or. cards%which == rows_every .or. &
                       cards%which == rows_upto)
   end function none_asked

   !> Leave of rows those that a card asks for
   pure subroutine thin(card, n_lines, rows)
      !> The card
      type(print_type), intent(in) :: card
      !> Lines of a row
      integer, intent(in) :: n_lines
      !> Rows that it is about; those that it asks for
      logical, intent(inout) :: rows(:)

      integer :: i, n

      n = 0
      select case (card%which)
       case (rows_all)
         return
       case (rows_every)
         do i = 1, size(rows)
            if (.not. rows(i)) cycle
            rows(i) = mod(n, card%n) == 0
            n = n + 1
         end do
       case (rows_upto)
         if (real(count(rows), wp)*n_lines > card%n) rows = .false.
       case default
         rows = .false.
      end select
   end subroutine thin

   !> Rows whose body and place a card is about
   pure function is_inside(model, results, what, card) result(inside)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> The table, one of the `print_` parameters
      integer, intent(in) :: what
      !> The card
      type(print_type), intent(in) :: card
      !> Whether it is about a row
      logical, allocatable :: inside(:)

      logical, allocatable :: node(:), joint(:)
      integer :: k

      associate (mesh => model%mesh)
         node = of_body(mesh, card%body)
         if (what == print_joints .or. what == print_states) then
            joint = [(any(node(mesh%joint_nodes(:4, k))), k=1, size(mesh%joint_material))]
         end if
         select case (what)
          case (print_nodes, print_amplitude, print_totals, print_reactions)
            inside = node .and. within(card, mesh%coordinates)
          case (print_elements)
            inside = [((card%body == 0 .or. mesh%element_body(k) == card%body) .and. &
                       all(within(card, mesh%coordinates(:, mesh%element_nodes(:3, k)))), &
                       k=1, n_elements(mesh))]
          case (print_joints)
            inside = [(joint(k) .and. all(within(card, mesh%coordinates(:, &
                       mesh%joint_nodes(:2, k)))), k=1, size(joint))]
          case (print_stresses)
            inside = (card%body == 0 .or. mesh%element_body(results%point_element) == card%body) &
               .and. within(card, results%point_position)
          case (print_nodal)
            inside = node(results%nodal%node) .and. &
               within(card, mesh%coordinates(:, results%nodal%node))
          case default
            inside = joint(results%joint_point_joint) .and. &
               within(card, results%joint_point_position)
         end select
      end associate
   end function is_inside

   !> Which nodes belong to a body
   pure function of_body(mesh, body) result(node)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The body; 0 for any
      integer, intent(in) :: body
      !> Whether a node does
      logical, allocatable :: node(:)

      integer :: k

      allocate (node(n_nodes(mesh)), source=body == 0)
      if (body == 0) return
      do k = 1, n_elements(mesh)
         if (mesh%element_body(k) /= body) cycle
         node(mesh%element_nodes(:mesh%element_size(k), k)) = .true.
      end do
   end function of_body

   !> Whether places lie in the rectangle of a card
   pure function within(card, places) result(inside)
      !> The card
      type(print_type), intent(in) :: card
      !> r and z, shape (2, places)
      real(wp), intent(in) :: places(:, :)
      !> Whether they do
      logical, allocatable :: inside(:)

      integer :: k

      allocate (inside(size(places, 2)))
      do k = 1, size(inside)
         inside(k) = all(places(:, k) >= card%least .and. places(:, k) <= card%largest)
      end do
   end function within

   !> Say how many rows of a table are listed; nothing if all are
   subroutine write_left(file, name, n_listed, n)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Name of the table, behind a blank line; empty where a heading stands above
      character(len=*), intent(in) :: name
      !> Rows that are listed, and all
      integer, intent(in) :: n_listed, n

      character(len=:), allocatable :: text

      if (n_listed >= n) return
      text = to_text(n_listed)//' of '//count_of(n, 'row')//' listed: PRINT asks for more or '// &
         'less, the results file has all'
      if (name == '') then
         call file%put('  '//text)
      else
         call file%put('')
         call file%put(name//': '//text)
      end if
   end subroutine write_left

end module axijoint_output_listing_choice
