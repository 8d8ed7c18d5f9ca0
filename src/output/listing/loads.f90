!> Tables of the listing that show loads, supports that yield, and what the harmonics
!> leave of loads
module axijoint_output_listing_loads
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_fe_mode, only : mode_type, family_symmetric
   use axijoint_model_load, only : initial_stress_type, any_material
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : print_loads
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_heading, write_lines
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_listing_choice, only : chosen_lines, none_asked, write_left
   implicit none
   private
   public :: write_loads, write_truncations, write_supports, write_combinations

   !> Harmonic, family, load case, and number of a node or body
   character(len=*), parameter :: format_load = '(i10, 1x, a1, 2i10)'
   !> Numbers of nodes
   character(len=*), parameter :: format_nodes = '(2i10)'
   !> Columns of coordinates and of other reals
   integer, parameter :: narrow = 14, wide = 15
   !> Heading of the columns that `label` writes
   character(len=*), parameter :: label_heading = "  harmonic        case"

contains

   !> All loads, by kind
   subroutine write_loads(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      if (none_asked(model, print_loads)) return
      call write_heading(file, "LOADS (amplitudes for load factor 1; S symmetric, A antisymmetric)")
      if (size(model%edge_loads) + size(model%ring_loads) + size(model%body_loads) &
          + size(model%thermal_loads) + size(model%prescribed) + &
          size(model%initial_stresses) == 0) then
         call file%put("  none")
      end if
      if (size(model%edge_loads) > 0) call write_edge_loads(file, model)
      if (size(model%ring_loads) > 0) call write_ring_loads(file, model)
      if (size(model%body_loads) > 0) call write_body_loads(file, model)
      if (size(model%thermal_loads) > 0) call write_thermal_loads(file, model)
      if (size(model%prescribed) > 0) call write_prescribed(file, model)
      if (size(model%initial_stresses) > 0) call write_initial_stresses(file, model)
   end subroutine write_loads

   !> Harmonic, family, case and number at the start of a line
   pure function label(mode, case, number)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Number of the load case
      integer, intent(in) :: case
      !> Number of a node or body
      integer, intent(in) :: number
      !> The text
      character(len=32) :: label

      write (label, format_load) mode%harmonic, merge("S", "A", mode%family == family_symmetric), &
         case, number
   end function label

   !> Tractions on edges, one line a node
   subroutine write_edge_loads(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      logical, allocatable :: listed(:)
      integer :: i, k

      call file%put("  tractions on edges: first, last and middle node of each edge")
      call file%put(label_heading//"      node             r             z            "// &
         "t_r            t_z"// &
         "        t_theta")
      listed = chosen_lines(model, print_loads, size(model%edge_loads))
      do i = 1, size(model%edge_loads)
         if (.not. listed(i)) cycle
         associate (load => model%edge_loads(i))
            do k = 1, count(load%nodes > 0)
               call file%put(label(load%mode, model%load_cases(load%case)%label, &
                  model%mesh%node_label(load%nodes(k)))// &
                  columns(model%mesh%coordinates(:, load%nodes(k)), narrow)// &
                  columns(load%traction(:, k), wide))
            end do
         end associate
      end do
      call write_left(file, "", count(listed), size(listed))
   end subroutine write_edge_loads

   !> Loads on nodal circles
   subroutine write_ring_loads(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      logical, allocatable :: listed(:)
      integer :: i

      call file%put("  loads on nodal circles: generalized forces (work over the circle on "// &
         "unit "// &
         "amplitudes)")
      call file%put(label_heading//"      node             r             z            "// &
         "F_u            F_v"// &
         "            F_w")
      listed = chosen_lines(model, print_loads, size(model%ring_loads))
      do i = 1, size(model%ring_loads)
         if (.not. listed(i)) cycle
         associate (load => model%ring_loads(i))
            call file%put(label(load%mode, model%load_cases(load%case)%label, &
               model%mesh%node_label(load%node))// &
               columns(model%mesh%coordinates(:, load%node), narrow)//columns(load%force, wide))
         end associate
      end do
      call write_left(file, "", count(listed), size(listed))
   end subroutine write_ring_loads

   !> Accelerations of all solids
   subroutine write_body_loads(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=32) :: start
      integer :: i

      call file%put("  accelerations: the forces are density times these")
      call file%put(label_heading//"                     a_r            a_z        a_theta"// &
         "   a_r per radius")
      do i = 1, size(model%body_loads)
         associate (load => model%body_loads(i))
            start = label(load%mode, model%load_cases(load%case)%label, 0)
            call file%put(start(:22)//repeat(" ", 10)// &
               columns([load%acceleration, load%spin_squared], wide))
         end associate
      end do
   end subroutine write_body_loads

   !> Temperatures: smallest and largest amplitude of each field
   subroutine write_thermal_loads(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      call file%put("  temperatures: smallest and largest amplitude at the nodes (body 0: all "// &
         "bodies)")
      call file%put(label_heading//"      body       smallest        largest")
      do i = 1, size(model%thermal_loads)
         associate (load => model%thermal_loads(i))
            call file%put(label(load%mode, model%load_cases(load%case)%label, load%body)// &
               columns([minval(load%temperature), maxval(load%temperature)], wide))
         end associate
      end do
   end subroutine write_thermal_loads

   !> Displacements that are not zero
   subroutine write_prescribed(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=1), parameter :: component(3) = ["u", "v", "w"]
      logical, allocatable :: listed(:)
      integer :: i

      call file%put("  prescribed displacements (the component is zero in all other modes and "// &
         "cases)")
      call file%put(label_heading//"      node             r             z   component      "// &
         "amplitude")
      listed = chosen_lines(model, print_loads, size(model%prescribed))
      do i = 1, size(model%prescribed)
         if (.not. listed(i)) cycle
         associate (load => model%prescribed(i))
            call file%put(label(load%mode, model%load_cases(load%case)%label, &
               model%mesh%node_label(load%node))// &
               columns(model%mesh%coordinates(:, load%node), narrow)//repeat(" ", 11)// &
               component(load%component)//columns([load%value], wide))
         end associate
      end do
      call write_left(file, "", count(listed), size(listed))
   end subroutine write_prescribed

   !> In-situ stresses
   subroutine write_initial_stresses(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      call file%put("  in-situ stresses: at z = 0, and below each their growth with z")
      call file%put(label_heading//"      body        sigma_r        sigma_z    "// &
         "sigma_theta         tau_rz")
      do i = 1, size(model%initial_stresses)
         associate (load => model%initial_stresses(i))
            call file%put(label(mode_type(), model%load_cases(load%case)%label, load%body)// &
               columns(load%stress, wide))
            call file%put(share_text(model, load)//columns(load%gradient, wide))
         end associate
      end do
   end subroutine write_initial_stresses

   !> Material of an in-situ stress, if it is of one, and whether it is meant to be out of balance
   pure function share_text(model, stress) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The stress
      type(initial_stress_type), intent(in) :: stress
      !> The words
      character(len=32) :: text

      text = ""
      if (stress%material /= any_material) &
         text = "    material "//to_text(model%materials(stress%material)%label)
      if (stress%meant) text = trim(text)//"    meant"
   end function share_text

   !> Springs to the ground; nothing if there are none
   subroutine write_supports(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=20) :: nodes
      integer :: i

      if (size(model%edge_supports) == 0) return
      call write_heading(file, "SPRINGS TO THE GROUND")
      call file%put("   nodes of the edge            k_n            k_s        k_theta")
      do i = 1, size(model%edge_supports)
         associate (support => model%edge_supports(i))
            write (nodes, format_nodes) model%mesh%node_label(support%nodes(:2))
            call file%put(nodes//columns(support%stiffness, wide))
         end associate
      end do
   end subroutine write_supports

   !> What the harmonics in use leave of each load; nothing if no load is a function of theta
   subroutine write_truncations(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      if (size(model%truncations) == 0) return
      call write_heading(file, "WHAT THE HARMONICS LEAVE OF EACH LOAD")
      call file%put("  root mean square round the circle of what is left out, over that of the "// &
         "load; "// &
         "1 for a load")
      call file%put("  that is concentrated in points: its work is exact in every harmonic in use")
      do i = 1, size(model%truncations)
         call file%put(columns([model%truncations(i)%left_out], wide)//"  "// &
            model%truncations(i)%name)
      end do
   end subroutine write_truncations

   !> Load cases and their combinations; nothing if there is one case without a name
   subroutine write_combinations(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=:), allocatable :: sum_text
      integer :: i, k

      if (size(model%load_cases) == 1 .and. size(model%combinations) == 1 &
          .and. len(model%load_cases(1)%name) == 0) return
      call write_heading(file, "LOAD CASES AND COMBINATIONS")
      do i = 1, size(model%load_cases)
         associate (load_case => model%load_cases(i))
            call file%put("  case "//to_text(load_case%label)//"   "//load_case%name)
         end associate
      end do
      do k = 1, size(model%combinations)
         associate (combination => model%combinations(k))
            sum_text = ""
            do i = 1, size(combination%factor)
               if (.not. abs(combination%factor(i)) > 0.0_wp) cycle
               if (len(sum_text) > 0) sum_text = sum_text//" + "
               sum_text = sum_text//to_text(combination%factor(i))//" case "// &
                  to_text(model%load_cases(i)%label)
            end do
            call write_lines(file, "  combination "//to_text(combination%label)//" = ", sum_text)
         end associate
      end do
   end subroutine write_combinations

end module axijoint_output_listing_loads
