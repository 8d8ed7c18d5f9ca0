!> Tables of the listing that show the job as the program understood it
module axijoint_output_listing_model
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_element_joint_law, only : law_elastic, law_names, slip_names, opening_names
   use axijoint_element_yield_law, only : yield_none, criterion_names
   use axijoint_fe_element_kind, only : formulations
   use axijoint_model_material, only : rule_names
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, n_joints, element_references
   use axijoint_model_model, only : model_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_heading, write_lines
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_warnings, write_model, write_materials, write_joint_materials
   public :: write_increments

   !> A word and what belongs to it
   character(len=*), parameter :: format_fact = '(2x, a, t34, a)'
   !> Number of an entry
   character(len=*), parameter :: format_label = '(i10)'
   !> Most iterations of an increment
   character(len=*), parameter :: format_iterations = '(i12)'
   !> Pairs of directions of an orthotropic material
   character(len=*), parameter :: pairs(3) = ['12', '23', '13']
   !> Columns of reals
   integer, parameter :: wide = 15

contains

   !> Warnings of the deck
   subroutine write_warnings(file, warnings)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> One warning an entry
      character(len=*), intent(in) :: warnings(:)

      integer :: i

      call write_heading(file, "WARNINGS")
      if (size(warnings) == 0) call file%put("  none")
      do i = 1, size(warnings)
         call write_lines(file, "  ", trim(warnings(i)), of_words=.true.)
      end do
   end subroutine write_warnings

   !> Numbers of everything, extent, harmonics, planes
   subroutine write_model(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      associate (mesh => model%mesh)
         call write_heading(file, "MODEL")
         call write_fact(file, "nodes", to_text(n_nodes(mesh)))
         call write_fact(file, "elements (3, 4, 6, 8, 9 nodes)", to_text(n_elements(mesh))//" ("// &
            to_text(count(mesh%element_size == 3))//", "// &
            to_text(count(mesh%element_size == 4))//", "// &
            to_text(count(mesh%element_size == 6))//", "// &
            to_text(count(mesh%element_size == 8))//", "// &
            to_text(count(mesh%element_size == 9))//")")
         call write_kinds(file, mesh)
         call write_fact(file, "joints (4, 6 nodes)", to_text(n_joints(mesh))//" ("// &
            to_text(count(mesh%joint_size == 4))//", "// &
            to_text(count(mesh%joint_size == 6))//")")
         call write_fact(file, "bodies", body_list(mesh))
         if (n_nodes(mesh) > 0) then
            call write_fact(file, "extent in r", extent_text(mesh%coordinates(1, :)))
            call write_fact(file, "extent in z", extent_text(mesh%coordinates(2, :)))
         end if
      end associate
      call write_fact(file, "highest harmonic M", to_text(model%max_harmonic))
      if (size(model%harmonics) <= model%max_harmonic) then
         call write_fact(file, "harmonics in use", number_list(model%harmonics))
      end if
      call write_fact(file, "planes theta from 0 to pi", to_text(model%n_planes))
      call write_fact(file, "restrained nodes", to_text(n_restrained(model)))
   end subroutine write_model

   !> Nodes that are held in any mode
   pure integer function n_restrained(model)
      !> The job
      type(model_type), intent(in) :: model

      logical :: held(n_nodes(model%mesh))
      integer :: k

      held = any(model%fixed, dim=1)
      if (allocated(model%restraints)) then
         do k = 1, size(model%restraints)
            held = held .or. any(model%restraints(k)%held, dim=1)
         end do
      end if
      n_restrained = count(held)
   end function n_restrained

   !> Kinds of elements: nodes, points, formulation, and how many there are
   subroutine write_kinds(file, mesh)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The mesh
      type(mesh_type), intent(in) :: mesh

      integer :: k

      associate (references => element_references(mesh))
         do k = 1, size(mesh%kinds)
            associate (title => formulations(mesh%kinds(k)%formulation)%title)
               call write_fact(file, trim(merge("kinds of elements", "                 ", &
                  k == 1)), &
                               to_text(count(mesh%element_kind == k))//" of "// &
                               to_text(mesh%kinds(k)%n_nodes)// &
                               " nodes, "//to_text(references(k)%n_points)//" points"// &
                               trim(merge(", ", "  ", title /= ""))//trim(" "//title))
            end associate
         end do
      end associate
   end subroutine write_kinds

   !> Materials of the solids
   subroutine write_materials(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=10) :: label
      integer :: i

      call write_heading(file, "MATERIALS")
      call file%put("  material              E             nu        density      expansion")
      do i = 1, size(model%materials)
         associate (material => model%materials(i))
            if (material%orthotropic) cycle
            write (label, format_label) material%label
            call file%put(label//columns([material%young, material%poisson, material%density, &
                                          material%expansion(1)], wide))
         end associate
      end do
      call write_orthotropic(file, model)
      call write_yield(file, model)
   end subroutine write_materials

   !> How solids yield
   subroutine write_yield(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=:), allocatable :: text
      character(len=10) :: label
      integer :: i

      if (all(model%materials%yield%criterion == yield_none)) return
      call write_heading(file, "MATERIALS THAT YIELD")
      call file%put("  material  criterion       strength      phi [deg]      psi [deg]"// &
         "             H'        tension       gradient            z_s")
      do i = 1, size(model%materials)
         associate (material => model%materials(i), law => model%materials(i)%yield)
            if (law%criterion == yield_none) cycle
            write (label, format_label) material%label
            text = label//"    "//criterion_names(law%criterion)//columns([law%strength, &
               law%friction/degree, law%dilation/degree, law%hardening], wide)
            if (law%tension < huge(1.0_wp)) then
               text = text//columns([law%tension], wide)
            else
               text = text//repeat(" ", wide - 1)//"-"
            end if
            if (law%gradient > 0.0_wp) text = text//columns([law%gradient, law%level], wide)
            call file%put(text)
         end associate
      end do
   end subroutine write_yield

   !> Orthotropic materials of the solids
   subroutine write_orthotropic(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=:), allocatable :: text
      character(len=10) :: label
      integer :: i, j

      if (.not. any(model%materials%orthotropic)) return
      call write_heading(file, "ORTHOTROPIC MATERIALS")
      call file%put("  material  direction            E      expansion  pair             nu" &
                    //"              G    angle [deg]        density")
      do i = 1, size(model%materials)
         associate (material => model%materials(i))
            if (.not. material%orthotropic) cycle
            do j = 1, 3
               write (label, format_label) material%label
               if (j > 1) label = ''
               text = label//'          '//to_text(j) &
                  //columns([material%moduli(j), material%expansion(j)], wide)//'    '//pairs(j) &
                  //columns([material%ratios(j), material%shears(j)], wide)
               if (j == 1) text = text//columns([material%angle/degree, material%density], wide)
               call file%put(text)
            end do
         end associate
      end do
   end subroutine write_orthotropic

   !> Laws of the joints
   subroutine write_joint_materials(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=10) :: label
      integer :: i

      if (size(model%joint_materials) == 0) return
      call write_heading(file, "JOINT LAWS")
      call file%put("       law           k_xi          k_eta        k_theta              C"// &
         "     phi [deg]   law      rule")
      do i = 1, size(model%joint_materials)
         associate (material => model%joint_materials(i))
            write (label, format_label) material%label
            call file%put(label//columns([material%law%stiffness, material%law%cohesion, &
               atan(material%law%friction)/degree], wide)//"  "// &
               law_names(material%law%kind)//"  "//rule_names(material%rule))
         end associate
      end do
      if (all(model%joint_materials%law%kind == law_elastic)) return
      call file%put("")
      call file%put("       law   slip        opening     residual C residual [deg]      psi "// &
         "[deg]            gap"// &
         "  initial sigma")
      do i = 1, size(model%joint_materials)
         associate (material => model%joint_materials(i), law => model%joint_materials(i)%law)
            if (law%kind == law_elastic) cycle
            write (label, format_label) material%label
            call file%put(label//"   "//slip_names(law%slip)// &
               "  "//opening_names(law%opening)// &
               columns([merge(law%residual_cohesion, law%cohesion, law%softens), &
                        atan(merge(law%residual_friction, law%friction, law%softens))/degree, &
                        atan(law%dilation)/degree, law%gap, law%initial_stress], wide))
         end associate
      end do
   end subroutine write_joint_materials

   !> Load increments
   subroutine write_increments(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=*), parameter :: gap = "   "
      character(len=10) :: label
      character(len=12) :: iterations
      character(len=:), allocatable :: heading, text
      logical :: of_cases, steered
      integer :: i

      of_cases = any(model%increments%case > 0)
      steered = any(model%increments%steered)
      call write_heading(file, "LOAD INCREMENTS")
      heading = " increment         factor   total factor      tolerance  iterations"
      if (of_cases) then
         call file%put("  (total factor: of all load cases together, the load factor of the tables below)")
         heading = heading//"   of case      its total"
      end if
      if (steered) heading = heading//gap//"given"
      call file%put(heading)
      do i = 1, size(model%increments)
         associate (increment => model%increments(i))
            write (label, format_label) i
            write (iterations, format_iterations) increment%max_iterations
            text = label//columns([increment%factor, sum(model%increments(:i)%factor), increment%tolerance], wide)//iterations
            if (of_cases) text = text//case_of(model, i)
            if (steered) text = text//gap//trim(merge("displacement", "load        ", increment%steered))
            call file%put(text)
         end associate
      end do
   end subroutine write_increments

   !> Columns of the load case of an increment
   pure function case_of(model, i) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> The increment
      integer, intent(in) :: i
      !> Its number and factor at the end of the increment; of an increment of all cases, which may differ then, no factor
      character(len=:), allocatable :: text

      character(len=10) :: label
      integer :: case

      case = model%increments(i)%case
      if (case == 0) then
         text = repeat(" ", 7)//"all"//repeat(" ", 14)//"-"
      else
         write (label, format_label) model%load_cases(case)%label
         associate (before => model%increments(:i))
            text = label//columns([sum(before%factor, mask=before%case == case .or. before%case == 0)], wide)
         end associate
      end if
   end function case_of

   !> A line of a word and its value
   subroutine write_fact(file, word, value)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> What it is
      character(len=*), intent(in) :: word
      !> Its value
      character(len=*), intent(in) :: value

      character(len=132) :: line

      write (line, format_fact) word, value
      call file%put(line)
   end subroutine write_fact

   !> Numbers of the bodies with their elements, such as 1 (24 elements), 2 (60)
   pure function body_list(mesh) result(text)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The list; not more bodies than fit on a line
      character(len=:), allocatable :: text

      integer, parameter :: room = 80
      integer :: body

      text = ""
      body = minval(mesh%element_body)
      do while (n_elements(mesh) > 0)
         if (len(text) > 0) text = text//", "
         text = text//to_text(body)//" ("//to_text(count(mesh%element_body == body))//" elements)"
         if (.not. any(mesh%element_body > body)) return
         if (len(text) > room) then
            text = text//", ..."
            return
         end if
         body = minval(mesh%element_body, mask=mesh%element_body > body)
      end do
   end function body_list

   !> Numbers, not more than fit on a line
   pure function number_list(numbers) result(text)
      !> The numbers
      integer, intent(in) :: numbers(:)
      !> Such as 0, 2, 4
      character(len=:), allocatable :: text

      integer, parameter :: room = 80
      integer :: i

      text = ""
      do i = 1, size(numbers)
         if (len(text) > room) then
            text = text//", ..."
            return
         end if
         if (i > 1) text = text//", "
         text = text//to_text(numbers(i))
      end do
   end function number_list

   !> Smallest to largest value
   pure function extent_text(values) result(text)
      !> Values, at least one
      real(wp), intent(in) :: values(:)
      !> Such as 0 to 2
      character(len=:), allocatable :: text

      text = to_text(minval(values))//" to "//to_text(maxval(values))
   end function extent_text

end module axijoint_output_listing_model
