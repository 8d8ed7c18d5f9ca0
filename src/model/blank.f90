!> An empty job, to which bodies, joints and loads are added
module axijoint_model_blank
   use axijoint_base_kinds, only : wp, pi
   use axijoint_model_load, only : combination_type, load_case_type
   use axijoint_model_mesh, only : mesh_type, max_element_nodes
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : default_keep
   implicit none
   private
   public :: new_model

   !> Most iterations of the increment
   integer, parameter :: most_iterations = 500

contains

   !> A job without bodies, with what a deck says by default: 4 M + 1 planes, Newton's method, one
   !> load case, one increment of the whole load
   pure function new_model(title, max_harmonic) result(model)
      !> What the job is
      character(len=*), intent(in) :: title
      !> Highest harmonic M
      integer, intent(in) :: max_harmonic
      !> The job
      type(model_type) :: model

      integer :: m

      model%title = title
      model%max_harmonic = max_harmonic
      model%harmonics = [(m, m=0, max_harmonic)]
      model%n_planes = max(2, 4*max_harmonic + 1)
      model%output_angles = [0.0_wp, 0.5_wp*pi, pi]
      model%load_cases = [load_case_type(label=1, name='')]
      model%combinations = [combination_type(label=1, factor=[1.0_wp])]
      allocate (model%increments(1))
      model%increments(1)%max_iterations = most_iterations
      model%keep = default_keep()
      call make_empty(model%mesh)
      allocate (model%materials(0), model%joint_materials(0), model%interfaces(0), &
         model%fixed(3, 0))
      allocate (model%edge_loads(0), model%ring_loads(0), model%body_loads(0), &
         model%thermal_loads(0))
      allocate (model%prescribed(0), model%initial_stresses(0), model%edge_supports(0), &
         model%truncations(0), model%left_out(0))
      allocate (model%lines(0), model%points(0), model%cuts(0), model%supported_faces(0))
   end function new_model

   !> A mesh without nodes
   pure subroutine make_empty(mesh)
      !> The mesh
      type(mesh_type), intent(out) :: mesh

      allocate (mesh%coordinates(2, 0), mesh%node_label(0), mesh%shared_label(2, 0), &
         mesh%element_label(0), &
         mesh%element_material(0))
      allocate (mesh%element_body(0), mesh%element_size(0), &
         mesh%element_nodes(max_element_nodes, 0))
      allocate (mesh%kinds(0), mesh%element_kind(0))
      allocate (mesh%joint_label(0), mesh%joint_material(0), mesh%joint_size(0), &
         mesh%joint_nodes(6, 0), mesh%joint_interface(0))
   end subroutine make_empty

end module axijoint_model_blank
