!> What the time of a run is made of: terms, each a count that is known before anything is solved,
!> times the seconds of one. The seconds were fitted to runs on one machine, whose rates of matrix
!> products and of common work are `axijoint_estimate_machine`'s; `scripts/bench estimate` fits
!> them anew and prints this table's last column.
module axijoint_estimate_terms
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: term_type, terms, n_terms, phase_names, n_phases, common, products, measured
   public :: beginning, reading, ordering, shape_products, fine_nodes, factoring, inverse, &
      block_entries, solved_entries, node_modes, laws, sums, flexibility, fine_blocks, &
      stress_modes, files, lines, array_bytes, swept_values, row_stresses, formed_entries, rows, &
      body_stresses, body_laws, cut_states, line_values

   !> Parts of a run, in their order
   integer, parameter :: n_phases = 8
   character(len=9), parameter :: phase_names(n_phases) = [character(len=9) :: &
      'read', 'assemble', 'factor', 'condense', 'joints', 'errors', 'recover', 'write']
   integer, parameter :: phase_read = 1, phase_assemble = 2, phase_factor = 3, &
      phase_condense = 4, phase_joints = 5, phase_errors = 6, phase_recover = 7, phase_write = 8
   !> What the speed of the machine does to a term: it goes with common work, with matrix products,
   !> or it is measured where the estimate is made, or expected for its rate, already
   integer, parameter :: common = 1, products = 2, measured = 3

   !> A term
   type :: term_type
      !> Its name, for `--counts` and the bench
      character(len=16) :: name = ''
      !> Phase, and one of the kinds of speed
      integer :: phase = 0, speed = common
      !> Whether threads share it, a harmonic each
      logical :: shared = .false.
      !> What is counted
      character(len=56) :: what = ''
      !> Seconds of one
      real(wp) :: seconds = 0.0_wp
   end type term_type

   integer, parameter :: beginning = 1, reading = 2, ordering = 3, shape_products = 4, &
      fine_nodes = 5, factoring = 6, inverse = 7, block_entries = 8, solved_entries = 9, &
      node_modes = 10, laws = 11, sums = 12, flexibility = 13, fine_blocks = 14, &
      stress_modes = 15, files = 16, lines = 17, array_bytes = 18, swept_values = 19, &
      row_stresses = 20, formed_entries = 21, rows = 22, body_stresses = 23, body_laws = 24, &
      cut_states = 25, line_values = 26
   integer, parameter :: n_terms = 26

   !> All of them, at the places above
   type(term_type), parameter :: terms(n_terms) = [ &
      term_type('beginning', phase_read, common, .false., &
                'start of the program', 1.2e-03_wp), &
      term_type('reading', phase_read, measured, .false., &
                'reading, as measured now', 1.0_wp), &
      term_type('ordering', phase_assemble, measured, .false., &
                'orders and plan of the equations, as measured now', 1.0_wp), &
      term_type('shape_products', phase_assemble, common, .false., &
                'pairs of nodes at Gauss points, both meshes', 1.1e-09_wp), &
      term_type('fine_nodes', phase_assemble, common, .false., &
                'nodes of the mesh half as large', 3.3e-06_wp), &
      term_type('factoring', phase_factor, measured, .true., &
                'factors, by operations and entries', 1.0e+00_wp), &
      term_type('inverse', phase_condense, products, .true., &
                'operations on the flexibilities of joints', 2.4e-11_wp), &
      term_type('block_entries', phase_condense, common, .true., &
                'entries of flexibilities', 1.4e-09_wp), &
      term_type('solved_entries', phase_joints, common, .true., &
                'entries of factors, solution by solution', 2.3e-10_wp), &
      term_type('node_modes', phase_joints, common, .false., &
                'loads and displacements, node by mode', 1.8e-06_wp), &
      term_type('laws', phase_joints, common, .false., &
                'laws at points and planes', 1.7e-07_wp), &
      term_type('sums', phase_joints, common, .false., &
                'sums of harmonics on planes', 5.4e-10_wp), &
      term_type('flexibility', phase_joints, common, .false., &
                'products with flexibilities', 4.1e-10_wp), &
      term_type('fine_blocks', phase_errors, common, .true., &
                'stiffness of the mesh half as large', 6.4e-08_wp), &
      term_type('stress_modes', phase_recover, common, .false., &
                'stresses at Gauss points, mode by mode', 1.2e-08_wp), &
      term_type('files', phase_write, common, .false., &
                'files opened, closed and named', 1.6e-02_wp), &
      term_type('lines', phase_write, common, .false., &
                'lines of the listing', 3.0e-07_wp), &
      term_type('array_bytes', phase_write, common, .false., &
                'bytes of the results file', 2.7e-09_wp), &
      term_type('swept_values', phase_write, common, .false., &
                'numbers for ParaView', 1.7e-07_wp), &
      term_type('row_stresses', phase_recover, common, .false., &
                'quantities of rows', 4.0e-10_wp), &
      term_type('formed_entries', phase_factor, common, .true., &
                'entries of matrices', 1.5e-08_wp), &
      term_type('rows', phase_recover, common, .false., &
                'increments of rows: their fields, quantities, notes', 1.0e-03_wp), &
      term_type('body_stresses', phase_joints, common, .true., &
                'stress and forces of bodies that yield', 5.4e-8_wp), &
      term_type('body_laws', phase_joints, common, .true., &
                'criteria at points and planes of bodies', 5.4e-7_wp), &
      term_type('cut_states', phase_recover, common, .false., &
                'resultants and motions at cuts', 1.25e-5_wp), &
      term_type('line_values', phase_recover, common, .false., &
                'displacements and stresses on sections, mode by mode', 1.1e-7_wp)]

end module axijoint_estimate_terms
