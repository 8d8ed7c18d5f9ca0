!> The next mesh of a job that leaves too much error: more elements, where the error is
module axijoint_analysis_error_finer_mesh
   use axijoint_analysis_error_grading, only : grading_type, divide_strips
   use axijoint_analysis_error_size_field, only : wanted_sizes
   use axijoint_base_kinds, only : wp
   use axijoint_fe_element_kind, only : formulation_plain
   use axijoint_model_material, only : rule_centroid
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : refinement_type, goal_energy
   use axijoint_model_strips, only : n_intervals, n_cells
   implicit none
   private
   public :: refine_mesh, size_mesh

   !> Least and most that the elements along a side are multiplied by in a round, where blocks are
   !> graded on the average; most pieces of an interval then
   real(wp), parameter, public :: least = 1.3_wp
   real(wp), parameter :: most = 2.5_wp, most_pieces = 8.0_wp
   !> Most that the size of an element is divided by where the mesh is made anew
   real(wp), parameter :: most_sizes = 8.0_wp
   !> What 8-node elements in the place of 4-node ones divide the error of displacements by, about,
   !> and how many times the unknowns they have
   real(wp), parameter :: quadratic_gain = 4.0_wp, quadratic_growth = 3.0_wp
   !> Elements are made larger again by so much at most: where they become quadratic, where they
   !> are graded
   real(wp), parameter :: coarsest = 0.5_wp
   !> Part of the room for unknowns that is used: nodes are counted without their supports there
   real(wp), parameter :: ample = 0.95_wp
   !> Shortest side of an element, over the larger side of the rectangle round all nodes: faces know
   !> which nodes are on them to a tenth of it
   real(wp), parameter :: shortest = 1.0e-5_wp
   !> Order that errors of graded blocks fall with, over that of uniform ones at corners
   real(wp), parameter :: order_gain = 1.33_wp

contains

   !> Refine the mesh, as far as there is room for unknowns; 4-node elements become 8-node ones
   !> first, unless joints have the rule CENTROID
   subroutine refine_mesh(model, element_error, excess, order, room, refinement, changed)
      !> The job as it was solved
      type(model_type), intent(in) :: model
      !> Energy of the error of each element; empty if not known
      real(wp), intent(in) :: element_error(:)
      !> The error over what is left to the mesh
      real(wp), intent(in) :: excess
      !> Order that it falls with in uniform meshes with corners
      real(wp), intent(in) :: order
      !> The unknowns may become so many times as many
      real(wp), intent(in) :: room
      !> How it was refined
      type(refinement_type), intent(inout) :: refinement
      !> Becomes true if the mesh was refined
      logical, intent(inout) :: changed

      real(wp) :: finer, left, need
      logical :: convert, graded

      ! 4-node elements of another formulation than the plain one are chosen against locking
      associate (kinds => model%mesh%kinds)
         convert = any(kinds%n_nodes == 4) .and. .not. &
                   (refinement%quadratic .or. any(kinds%n_nodes == 4 &
                   .and. kinds%formulation /= formulation_plain))
      end associate
      ! joints judged at one point have four nodes
      if (any(model%joint_materials%rule == rule_centroid)) convert = .false.
      need = max(least**order, excess)
      left = room
      if (convert) then
         need = max(coarsest**order, excess/quadratic_gain**(order/1.5_wp))
         left = room/quadratic_growth
      end if
      left = min(most, sqrt(left))
      if (left < merge(coarsest, least, convert)) return
      graded = allocated(model%grid) .and. size(element_error) > 0
      if (graded) then
         call grade_blocks(model, element_error, need, order, left, refinement, finer)
      else
         finer = min(need**(1.0_wp/order), left)
      end if
      refinement%quadratic = refinement%quadratic .or. convert
      refinement%mesh = refinement%mesh*finer
      changed = .true.
   end subroutine refine_mesh

   !> Find the sizes of elements that a mesh made anew should have
   subroutine size_mesh(model, element_error, excess, order, room, refinement)
      !> The job as it was solved
      type(model_type), intent(in) :: model
      !> Energy of the error of each element; empty if not known
      real(wp), intent(in) :: element_error(:)
      !> The error over what is left to the mesh
      real(wp), intent(in) :: excess
      !> Order that it falls with in uniform meshes with corners
      real(wp), intent(in) :: order
      !> The unknowns may become so many times as many
      real(wp), intent(in) :: room
      !> How it was refined; takes the sizes
      type(refinement_type), intent(inout) :: refinement

      type(grading_type) :: wish
      real(wp) :: finer
      integer :: corners(size(element_error))

      if (size(element_error) == 0 .or. room < least**2) return
      wish = general_wish(model, max(least**order, excess), order)
      wish%fewest = coarsest
      wish%most = most_sizes
      wish%most_cells = ample*size(element_error)*min(most**2, room)
      associate (mesh => model%mesh)
         corners = merge(3, 4, mesh%element_size == 3 .or. mesh%element_size == 6)
         allocate (refinement%sizes(n_nodes(mesh)))
         call wanted_sizes(mesh%coordinates, mesh%element_nodes, corners, element_error, wish, &
                           refinement%sizes, finer)
      end associate
      refinement%mesh = refinement%mesh*finer
   end subroutine size_mesh

   !> What is wished for of blocks and of meshes made anew
   pure type(grading_type) function general_wish(model, need, order) result(wish)
      !> The job as it was solved
      type(model_type), intent(in) :: model
      !> The error is to fall to one over this
      real(wp), intent(in) :: need
      !> Order that it falls with in uniform meshes with corners
      real(wp), intent(in) :: order

      real(wp) :: power

      ! parts of the energy of the error are added up; the others follow it, the norm its root
      power = merge(2.0_wp, 1.0_wp, model%error_goal%quantity == goal_energy)
      wish%remains = need**(-power)
      wish%order = power*order_gain*order
      wish%degree = merge(1, 2, all(model%mesh%kinds%n_nodes <= 4))
      associate (x => model%mesh%coordinates)
         wish%shortest = shortest*maxval(maxval(x, 2) - minval(x, 2))
      end associate
   end function general_wish

   !> Divide the strips of the blocks anew
   subroutine grade_blocks(model, element_error, need, order, left, refinement, finer)
      !> The job as it was solved
      type(model_type), intent(in) :: model
      !> Energy of the error of each element
      real(wp), intent(in) :: element_error(:)
      !> The error is to fall to one over this
      real(wp), intent(in) :: need
      !> Order that it falls with in uniform meshes with corners
      real(wp), intent(in) :: order
      !> The elements along a side may become so many times as many, on the average
      real(wp), intent(in) :: left
      !> Takes the strips
      type(refinement_type), intent(inout) :: refinement
      !> How many times as many they become
      real(wp), intent(out) :: finer

      type(grading_type) :: wish
      real(wp) :: cells

      wish = general_wish(model, need, order)
      ! what was graded stays as fine: an error that has become small there is no reason to undo it
      wish%fewest = merge(1.0_wp, coarsest, allocated(refinement%strips))
      wish%most = most_pieces
      cells = n_cells(model%grid, n_intervals(model%grid%strips))
      wish%most_cells = max(cells, ample*cells*left**2)
      call divide_strips(model%grid, element_error, wish, refinement%strips)
      finer = sqrt(n_cells(model%grid, n_intervals(refinement%strips))/cells)
   end subroutine grade_blocks

end module axijoint_analysis_error_finer_mesh
