!> Sections of a deck and the fields of their cards: the one place that knows
!> the columns
module axijoint_deck_text_layout
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : nearest_word, to_text
   use axijoint_deck_text_common_fields, only : number, numbers, last_number, body, step, length, ratio, &
      angle, largest_body, largest_division, largest_harmonic
   use axijoint_deck_text_field, only : field_type, integer_field, real_field, word_field, code_field, &
      text_field, largest_number
   use axijoint_deck_text_load_fields, only : load_fields, harmonic_range
   use axijoint_element_joint_law, only : law_names, law_paper, law_elastic, slip_names, opening_names
   use axijoint_fe_element_kind, only : formulation_names
   use axijoint_model_material, only : rule_names
   use axijoint_model_model, only : method_names
   use axijoint_model_request, only : goal_names, goal_displacement
   use axijoint_solver_registry, only : known_solvers, solver_words
   implicit none
   private
   public :: section_names, section_fields, keyword_fields, nearest_section, cards_per_entry

   !> Last column of a card, and the last one of a keyword before the number of entries.
   !> A longer keyword leaves less room for that number
   integer, parameter, public :: card_width = 80, keyword_last = 10
   !> Letters of the longest keyword
   integer, parameter, public :: keyword_length = 12

   !> Number of keywords
   integer, parameter, public :: n_sections = 43
   integer, parameter, public :: section_title = 1, section_control = 2, section_nodes = 3, &
      section_lines = 4, section_elements = 5, section_blocks = 6, section_materials = 7, &
      section_laws = 8, section_joints = 9, section_faces = 10, section_chains = 11, &
      section_interfaces = 12, section_restraints = 13, section_fixed_faces = 14, &
      section_tractions = 15, section_resultants = 16, section_ring_loads = 17, &
      section_increments = 18, section_output = 19, section_include = 20, section_end = 21, &
      section_shapes = 22, section_pressures = 23, section_point_loads = 24, section_harmonics = 25, &
      section_orthotropic = 26, &
      section_gmsh = 27, section_groups = 28, section_gravity = 29, section_rotation = 30, &
      section_temperatures = 31, section_node_temps = 32, section_moved_nodes = 33, &
      section_moved_faces = 34, section_springs = 35, section_in_situ = 36, &
      section_case = 37, section_combine = 38, &
      section_sections = 39, section_cuts = 40, section_law_details = 41, section_sweep = 42, &
      section_error = 43

   !> The keywords
   character(len=keyword_length), parameter :: section_names(n_sections) = &
      [character(len=keyword_length) :: &
      'TITLE', 'CONTROL', 'NODES', 'LINES', 'ELEMENTS', 'BLOCKS', 'MATERIALS', 'LAWS', 'JOINTS', &
      'FACES', 'CHAINS', 'INTERFACES', 'RESTRAINTS', 'FIXEDFACES', 'TRACTIONS', 'RESULTANTS', &
      'RINGLOADS', 'INCREMENTS', 'OUTPUT', 'INCLUDE', 'END', &
      'SHAPES', 'PRESSURES', 'POINTLOADS', 'HARMONICS', 'ORTHOTROPIC', &
      'GMSH', 'GROUPS', 'GRAVITY', 'ROTATION', 'TEMPERATURES', 'NODETEMPS', 'MOVEDNODES', &
      'MOVEDFACES', 'SPRINGS', 'INSITU', 'CASE', 'COMBINE', 'SECTIONS', 'CUTS', &
      'LAWDETAILS', 'SWEEP', 'ERROR']

   !> Kinds of groups on the cards of GROUPS
   character(len=5), parameter, public :: group_kinds(3) = [character(len=5) :: 'BODY', 'FACE', 'JOINT']

contains

   !> The section that a misspelt keyword most likely means; 0 if none
   pure integer function nearest_section(word)
      !> The keyword
      character(len=*), intent(in) :: word
      nearest_section = nearest_word(word, section_names)
   end function nearest_section

   !> Number of cards that make an entry of a section
   pure integer function cards_per_entry(section)
      !> The section
      integer, intent(in) :: section
      cards_per_entry = merge(2, 1, section == section_blocks .or. section == section_orthotropic)
   end function cards_per_entry

   !> Fields of a keyword card: the keyword and the number of entries
   pure function keyword_fields(section) result(fields)
      !> The section
      integer, intent(in) :: section
      !> The fields; TITLE and END have no entries to count
      type(field_type), allocatable :: fields(:)

      fields = [text_field('the keyword', 1, keyword_last), &
                integer_field('the number of entries', keyword_last + 1, keyword_last + 5, &
                              0, largest_number, default=0)]
      if (section == section_title .or. section == section_end) fields = fields(:1)
   end function keyword_fields

   !> Fields of the cards of a section, in the order of their columns
   pure function section_fields(section) result(fields)
      !> The section
      integer, intent(in) :: section
      !> The fields
      type(field_type), allocatable :: fields(:)

      select case (section)
      case (section_control, section_increments, section_output)
         fields = job_fields(section)
      case (section_nodes)
         fields = [number('the node', 1), length('r', 6, 0.0_wp), length('z', 16)]
      case (section_lines)
         fields = [number('the first node', 1), number('the last node', 6), step(11), ratio('the ratio', 16)]
      case (section_elements)
         fields = [number('the element', 1), number('the material', 6), body(11), numbers('node', 9, 3, 16)]
      case (section_blocks)
         fields = block_fields()
      case (section_materials, section_orthotropic, section_laws, section_law_details)
         fields = property_fields(section)
      case (section_joints)
         fields = [number('the joint', 1), number('the law', 6), numbers('node', 6, 4, 11)]
      case (section_faces)
         fields = [number('the face', 1), body(6), length('r of the first point', 11, 0.0_wp), &
                   length('z of the first point', 21), length('r of the last point', 31, 0.0_wp), &
                   length('z of the last point', 41)]
      case (section_chains)
         fields = [number('the face', 1), numbers('node', 15, 2, 6)]
      case (section_interfaces)
         fields = [number('the law', 1), number('face a', 6), number('face b', 11)]
      case (section_restraints)
         fields = [number('the node', 1), code_field('the code', 6, 10), &
                   last_number('the last node', 11), step(16), harmonic_range(21)]
      case (section_groups)
         fields = group_fields()
      case (section_sections, section_cuts, section_sweep, section_error)
         fields = request_fields(section)
      case (section_fixed_faces)
         fields = [number('the face', 1), code_field('the code', 6, 10), harmonic_range(11)]
      case default
         fields = load_fields(section_names(section))
      end select
   end function section_fields

   !> Fields of CONTROL, INCREMENTS and OUTPUT
   pure function job_fields(section) result(fields)
      !> The section
      integer, intent(in) :: section
      !> The fields
      type(field_type), allocatable :: fields(:)

      integer :: i

      select case (section)
      case (section_control)
         fields = [integer_field('the highest harmonic M', 1, 5, 0, largest_harmonic), &
                   integer_field('the number of planes', 6, 10, 2, largest_division, default=0), &
                   integer_field('the number of Gauss points (linear)', 11, 15, 2, 3, default=2), &
                   integer_field('the number of Gauss points (quadratic)', 16, 20, 2, 3, default=3), &
                   word_field('the solver', 21, 30, solver_words(known_solvers()), 1), &
                   word_field('the formulation of 4-node elements', 31, 40, formulation_names, 1), &
                   word_field('the method', 41, 50, method_names, 1)]
      case (section_increments)
         fields = [real_field('the load factor', 1, 10), &
                   real_field('the tolerance', 11, 20, above=0.0_wp, below=1.0_wp, default=1.0e-6_wp, &
                              symbol='tolerance'), &
                   integer_field('the most iterations', 21, 25, 1, largest_number, default=500), &
                   integer_field('the load case', 26, 30, 1, largest_number, default=0)]
      case default
         fields = [(real_field('angle '//to_text(i), 10*i - 9, 10*i, from=-360.0_wp, to=360.0_wp, &
                               default=0.0_wp, symbol='theta'), i=1, 8)]
         fields(1)%required = .true.
      end select
   end function job_fields

   !> Fields of the two cards of a block
   pure function block_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      character(len=1), parameter :: axis(0:1) = ['r', 'z']
      type(field_type) :: corner
      integer :: i

      fields = [body(1), number('the material', 6), integer_field('the number of nodes per element', 11, 15, 3, 9), &
                integer_field('the number of elements along 1-2', 16, 20, 1, largest_division), &
                integer_field('the number of elements along 2-3', 21, 25, 1, largest_division), &
                ratio('the ratio along 1-2', 26), ratio('the ratio along 2-3', 36)]
      do i = 0, 7
         corner = real_field(axis(mod(i, 2))//' of corner '//to_text(i/2 + 1), 10*i + 1, 10*i + 10, &
                             symbol=axis(mod(i, 2)))
         if (mod(i, 2) == 0) corner%low = 0.0_wp
         corner%card = 2
         corner%required = i < 4
         fields = [fields, corner]
      end do
   end function block_fields

   !> Fields of SECTIONS, CUTS and SWEEP
   pure function request_fields(section) result(fields)
      !> The section
      integer, intent(in) :: section
      !> The fields
      type(field_type), allocatable :: fields(:)

      integer :: i

      if (section == section_sections) then
         fields = [number('the section', 1), length('r of the first point', 6, 0.0_wp), &
                   length('z of the first point', 16), length('r of the last point', 26, 0.0_wp), &
                   length('z of the last point', 36), &
                   integer_field('the number of points', 46, 50, 2, largest_division, default=11), &
                   (angle('angle '//to_text(i), 41 + 10*i), i=1, 3)]
      else if (section == section_sweep) then
         fields = [real_field('the first angle', 1, 10, from=-360.0_wp, to=360.0_wp, default=0.0_wp, &
                              symbol='theta'), &
                   real_field('the last angle', 11, 20, from=-360.0_wp, to=360.0_wp, default=360.0_wp, &
                              symbol='theta'), &
                   integer_field('the number of sectors', 21, 25, 1, largest_division, default=0)]
      else if (section == section_error) then
         fields = [real_field('the target', 1, 10, above=0.0_wp, to=100.0_wp), &
                   word_field('the quantity', 11, 20, goal_names, goal_displacement), &
                   integer_field('the most rounds', 21, 25, 1, 99, default=8), &
                   integer_field('the most unknowns', 26, 35, 1, 1000000000, default=1000000)]
      else
         fields = [number('the cut', 1), length('z', 6), body(16)]
      end if
   end function request_fields

   !> Fields of GROUPS
   pure function group_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      fields = [word_field('the kind of group', 1, 10, group_kinds), &
                number('the number', 11), number('the material', 16), text_field('the name of the group', 21, 80)]
      fields(3)%required = .false.
   end function group_fields

   !> Fields of MATERIALS, ORTHOTROPIC and LAWS
   pure function property_fields(section) result(fields)
      !> The section
      integer, intent(in) :: section
      !> The fields
      type(field_type), allocatable :: fields(:)

      if (section == section_materials) then
         fields = [number('the material', 1), real_field('Young''s modulus', 6, 15, above=0.0_wp, symbol='E'), &
                   real_field('Poisson''s ratio', 16, 25, from=0.0_wp, below=0.5_wp, symbol='nu'), &
                   real_field('the density', 26, 35, from=0.0_wp, default=0.0_wp, symbol='density'), &
                   real_field('the expansion', 36, 45, default=0.0_wp)]
      else if (section == section_orthotropic) then
         fields = orthotropic_fields()
      else if (section == section_law_details) then
         fields = law_detail_fields()
      else
         fields = [number('the law', 1), real_field('k_xi', 6, 15, from=0.0_wp, symbol='k_xi'), &
                   real_field('k_eta', 16, 25, above=0.0_wp, symbol='k_eta'), &
                   real_field('k_theta', 26, 35, from=0.0_wp, symbol='k_theta'), &
                   real_field('the cohesion', 36, 45, from=0.0_wp, default=0.0_wp, symbol='C'), &
                   real_field('the friction angle', 46, 55, from=0.0_wp, below=90.0_wp, default=0.0_wp, &
                              symbol='phi'), &
                   word_field('the kind of law', 56, 65, law_names([law_paper, law_elastic]), 1), &
                   word_field('the rule', 66, 75, rule_names, 2)]
      end if
   end function property_fields

   !> Fields of LAWDETAILS
   pure function law_detail_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      fields = [number('the law', 1), &
                word_field('the kind of slip', 6, 15, slip_names, 1), &
                word_field('the kind of opening', 16, 25, opening_names, 1), &
                real_field('the residual cohesion', 26, 35, from=0.0_wp, default=0.0_wp, symbol='C'), &
                real_field('the residual friction angle', 36, 45, from=0.0_wp, below=90.0_wp, &
                           default=0.0_wp, symbol='phi'), &
                real_field('the angle of dilation', 46, 55, from=0.0_wp, below=90.0_wp, default=0.0_wp, &
                           symbol='psi'), &
                real_field('the gap', 56, 65, from=0.0_wp, default=0.0_wp, symbol='gap'), &
                real_field('the initial normal stress', 66, 75, to=0.0_wp, default=0.0_wp, symbol='sigma')]
   end function law_detail_fields

   !> Fields of the two cards of an orthotropic material
   pure function orthotropic_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      character(len=2), parameter :: pairs(3) = ['12', '23', '13']
      type(field_type) :: second(7)
      integer :: i

      fields = [number('the material', 1), &
                (real_field('E_'//to_text(i), 10*i - 4, 10*i + 5, above=0.0_wp, symbol='E'), i=1, 3), &
                real_field('the angle of direction 1', 36, 45, from=-360.0_wp, to=360.0_wp, &
                           default=0.0_wp, symbol='angle'), &
                real_field('the density', 46, 55, from=0.0_wp, default=0.0_wp, symbol='density'), &
                (real_field('expansion '//to_text(i), 10*i + 46, 10*i + 55, default=0.0_wp), i=1, 2)]
      second = [(real_field('nu_'//pairs(i), 10*i - 9, 10*i), i=1, 3), &
                (real_field('G_'//pairs(i), 10*i + 21, 10*i + 30, above=0.0_wp, symbol='G'), i=1, 3), &
                real_field('expansion 3', 61, 70, default=0.0_wp)]
      second%card = 2
      fields = [fields, second]
   end function orthotropic_fields

end module axijoint_deck_text_layout
