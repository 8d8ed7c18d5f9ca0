!> A deck while it is read: what its sections have said so far, and what has been made of it.
!> Every section has a reader that takes and changes it
module axijoint_deck_job_deck
   use axijoint_deck_gmsh_import, only : gmsh_import_type
   use axijoint_deck_load_cases, only : cases_type
   use axijoint_deck_load_lists, only : load_lists_type
   use axijoint_deck_load_shapes, only : shapes_type
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_mesh_edges, only : edge_table_type
   use axijoint_deck_property_properties, only : properties_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_section, only : section_type
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_fe_element_kind, only : kind_choice_type
   use axijoint_model_model, only : model_type
   use axijoint_model_strips, only : strip_type
   implicit none
   private
   public :: deck_type, read_section_type, reader_type, looked_at
   public :: stage_job, stage_properties, stage_elements, stage_blocks, stage_faces, stage_joints, &
      stage_loads, stage_requests, n_stages

   !> When a section is read. Control data, materials and laws, the mesh file
   integer, parameter :: stage_job = 1, stage_properties = 2
   !> Nodes and elements; blocks, which are numbered behind them
   integer, parameter :: stage_elements = 3, stage_blocks = 4
   !> Numbers of faces; joints
   integer, parameter :: stage_faces = 5, stage_joints = 6
   !> Harmonics, supports, loads; what is asked of the results
   integer, parameter :: stage_loads = 7, stage_requests = 8
   !> Number of stages
   integer, parameter :: n_stages = 8

   !> A deck while it is read
   type :: deck_type
      !> Its cards, the job that becomes of them, errors and warnings
      type(source_type), pointer :: source => null()
      type(model_type), pointer :: model => null()
      type(diagnostics_type), pointer :: diagnostics => null()
      !> Entries of the sections
      type(sections_type) :: sections
      !> Materials and laws
      type(properties_type) :: properties
      !> The mesh file, and the mesh
      type(gmsh_import_type) :: import
      type(draft_type) :: draft
      !> Rules and formulation of the elements, but where KINDS says others
      type(kind_choice_type) :: choice
      !> Edges of the elements, and number of each node's place, once the mesh is sound
      type(edge_table_type) :: edges
      integer, allocatable :: group(:)
      !> Highest harmonic of the job, negative if it is not known; those in use, all up to M
      !> unless HARMONICS gives others
      integer :: highest = -1
      integer, allocatable :: harmonics(:)
      !> Functions of theta, load cases, loads
      type(shapes_type) :: shapes
      type(cases_type) :: cases
      type(load_lists_type) :: loads
      !> Whether the strips of blocks are asked for, and how they are to be divided, if not as the
      !> cards say
      logical :: strips_wanted = .false.
      type(strip_type), allocatable :: strips(:)
   end type deck_type

   !> A section with its reader
   type, extends(section_type) :: read_section_type
      !> When it is read, one of the `stage_` parameters
      integer :: stage = stage_requests
      !> Reads its entries
      procedure(section_reader), pointer, nopass :: read => null()
   end type read_section_type

   !> The reader of a section
   type :: reader_type
      !> When the section is read, one of the `stage_` parameters
      integer :: stage = stage_requests
      !> Reads its entries; null if the section is read with another or by the source reader
      procedure(section_reader), pointer, nopass :: read => null()
   end type reader_type

   abstract interface
      !> Read the entries of a section into the deck
      subroutine section_reader(deck)
         import :: deck_type
         !> The deck
         type(deck_type), intent(inout), target :: deck
      end subroutine section_reader
   end interface

contains

   !> Harmonics that shapes and forces at points are decomposed into: those in use, and the first of those up to M that are not, as
   !> loads that have a part in such ones mostly have one in these
   pure function looked_at(deck) result(harmonics)
      !> The deck
      type(deck_type), intent(in) :: deck
      !> The harmonics, ascending
      integer, allocatable :: harmonics(:)

      !> The last that is looked at without being in use
      integer, parameter :: last = 64
      integer :: m

      harmonics = [[(m, m=0, min(last, max(0, deck%highest)))], pack(deck%harmonics, deck%harmonics > last)]
   end function looked_at

end module axijoint_deck_job_deck
