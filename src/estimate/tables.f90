!> How long the tables of a job are, and what the listing has of them
module axijoint_estimate_tables
   use axijoint_analysis_core_fields, only : nodal_stress_type
   use axijoint_analysis_core_nodal_stress, only : number_values
   use axijoint_base_kinds, only : wp
   use axijoint_deck_text_source, only : source_type
   use axijoint_estimate_body_work, only : n_body_points
   use axijoint_estimate_work, only : n_points
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type, bodies_yield, can_yield
   use axijoint_model_request, only : rows_expected, print_deck, print_nodes, print_elements, print_joints, print_loads, &
      print_path, print_amplitude, print_totals, print_stresses, print_nodal, print_states, print_reactions
   implicit none
   private
   public :: table_rows_type, new_table_rows, deck_bytes, listing_size

   !> Lengths of tables
   type :: table_rows_type
      !> Gauss points, those of bodies that yield, values of stress at nodes
      integer :: points = 0, own_points = 0, values = 0
      !> Points of joints, planes or angles at which these are shown
      integer :: joint_points = 0, planes = 0
      !> Iterations
      integer :: iterations = 0
      !> Whether errors are estimated
      logical :: judged = .false.
   end type table_rows_type

   !> Lines of the listing that each job has, of each mode, of each angle, of each section at each angle
   real(wp), parameter :: least_lines = 140.0_wp, mode_lines = 8.0_wp, angle_lines = 12.0_wp, section_lines = 8.0_wp
   !> Cards below a keyword that are listed of a long deck, too, and keywords that have so many, as a rule
   real(wp), parameter :: first_cards = 20.0_wp, long_lists = 3.0_wp
   !> Bytes of a line of each table
   real(wp), parameter :: of_heading = 62.0_wp, of_margin = 9.0_wp, of_node = 39.0_wp, of_element = 113.0_wp, &
      of_joint = 62.0_wp, of_load = 105.0_wp, of_increment = 67.0_wp, of_path = 79.0_wp, of_step = 81.0_wp, &
      of_state = 124.0_wp, of_vector = 82.0_wp, of_stress = 124.0_wp, of_joint_state = 128.0_wp, &
      of_section_vector = 90.0_wp, of_section_stress = 129.0_wp, of_cut = 117.0_wp, of_point = 70.0_wp

contains

   !> Lengths of the tables of a job
   function new_table_rows(model, modes, points, iterations, judged) result(rows)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Iterations of a combination
      real(wp), intent(in) :: iterations
      !> Whether errors are estimated
      logical, intent(in) :: judged
      !> The lengths
      type(table_rows_type) :: rows

      type(nodal_stress_type) :: nodal

      call number_values(model%mesh, nodal)
      rows%values = size(nodal%node)
      rows%points = nint(n_points(model))
      if (bodies_yield(model)) rows%own_points = n_body_points(model)
      rows%joint_points = size(points)
      rows%planes = n_planes(model, modes)
      if (can_yield(model)) rows%iterations = nint(iterations)
      rows%judged = judged .and. .not. bodies_yield(model)
   end function new_table_rows

   !> Planes or angles at which joints are shown
   pure integer function n_planes(model, modes)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)

      n_planes = size(model%output_angles)
      if (.not. can_yield(model)) return
      n_planes = model%n_planes
      if (any(modes%family /= modes(1)%family)) n_planes = 2*(model%n_planes - 1)
   end function n_planes

   !> Bytes of the cards of a deck and their ends
   pure real(wp) function deck_bytes(source)
      !> The cards
      type(source_type), intent(in) :: source

      associate (cards => source%cards(:source%n_cards))
         deck_bytes = sum(real(max(0, cards%last - cards%first + 1) + 1, wp))
      end associate
   end function deck_bytes

   !> Lines of the listing of one combination, and their bytes
   function listing_size(model, source, modes, rows) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> Modes that are solved
      type(mode_type), intent(in) :: modes(:)
      !> Lengths of the tables
      type(table_rows_type), intent(in) :: rows
      !> Lines, bytes
      real(wp) :: total(2)

      real(wp) :: nodes, angles, n_modes

      nodes = n_nodes(model%mesh)
      angles = size(model%output_angles)
      n_modes = size(modes)
      total = 0.0_wp
      call add(least_lines + n_modes*mode_lines + angles*angle_lines, of_heading)
      call add_deck()
      call add(listed(print_nodes, nodes) + restrained_rows(), of_node)
      call add(listed(print_elements, real(n_elements(model%mesh), wp)), of_element)
      call add(listed(print_joints, real(n_joints(model%mesh), wp)), of_joint)
      call add_loads()
      call add(listed(print_path, real(rows%iterations, wp)), of_path)
      call add_increments(size(model%increments))
      call add(n_modes*listed(print_amplitude, nodes) + angles*listed(print_totals, nodes) &
               + n_modes*listed(print_reactions, real(count(any(model%fixed, 1)), wp)), of_vector)
      call add(angles*(listed(print_nodal, real(rows%values, wp)) + listed(print_stresses, real(rows%points, wp))), of_stress)
      call add(listed(print_states, real(rows%joint_points, wp)*rows%planes), of_joint_state)
      call add_sections()
      call add(real(size(model%cuts), wp), of_cut)
      call add(size(model%points)*angles*(size(model%increments) + 5), of_point)

   contains

      !> Add lines
      subroutine add(lines, bytes)
         !> How many
         real(wp), intent(in) :: lines
         !> Bytes of one
         real(wp), intent(in) :: bytes

         total = total + lines*[1.0_wp, bytes]
      end subroutine add

      !> Rows of a table that are listed
      pure real(wp) function listed(what, n)
         !> The table, one of the `print_` parameters
         integer, intent(in) :: what
         !> Its rows
         real(wp), intent(in) :: n

         listed = rows_expected(model%print, what, n)
      end function listed

      !> Add the deck: of a long one the first cards below each keyword, which are few
      subroutine add_deck()
         real(wp) :: cards, n

         cards = max(1, source%n_cards)
         n = listed(print_deck, cards)
         if (listed(print_deck, 1.0_wp) > 0.0_wp) n = max(n, min(cards, long_lists*first_cards))
         call add(n, of_margin + deck_bytes(source)/cards)
      end subroutine add_deck

      !> Nodes that are held in some modes, restraint by restraint
      pure real(wp) function restrained_rows() result(n)
         integer :: r

         n = 0.0_wp
         if (.not. allocated(model%restraints)) return
         do r = 1, size(model%restraints)
            n = n + listed(print_nodes, real(count(any(model%restraints(r)%held, 1)), wp))
         end do
      end function restrained_rows

      !> Add the loads
      subroutine add_loads()
         integer :: k

         do k = 1, size(model%edge_loads)
            call add(listed(print_loads, real(size(model%edge_loads), wp))/size(model%edge_loads) &
                     *count(model%edge_loads(k)%nodes > 0), of_load)
         end do
         call add(listed(print_loads, real(size(model%ring_loads), wp)) &
                  + listed(print_loads, real(size(model%prescribed), wp)) &
                  + size(model%body_loads) + size(model%thermal_loads), of_load)
      end subroutine add_loads

      !> Add the sections, each with a table of displacements and one of stresses at each of its angles
      subroutine add_sections()
         integer :: k

         do k = 1, size(model%lines)
            associate (n => real(size(model%lines(k)%points), wp), at => real(size(model%lines(k)%angles), wp))
               call add(at*n, of_section_vector)
               call add(at*n, of_section_stress)
               call add(at*section_lines, of_heading)
            end associate
         end do
      end subroutine add_sections

      !> Add the tables of increments
      subroutine add_increments(n)
         !> How many there are
         integer, intent(in) :: n

         call add(real(n, wp), of_increment)
         if (rows%iterations > 0) call add(real(n, wp), of_step)
         if (n > 1) call add(real(n, wp), of_state)
      end subroutine add_increments

   end function listing_size

end module axijoint_estimate_tables
