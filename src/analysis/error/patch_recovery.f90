!> Stresses recovered on patches: polynomials fitted to where the stresses of elements are best
!> (Zienkiewicz and Zhu, Int. J. Numer. Meth. Eng. 33, 1992), a patch for each element
!> (Wiberg and Li, Comm. Numer. Meth. Eng. 10, 1994)
module axijoint_analysis_error_patch_recovery
   use axijoint_analysis_error_polynomial_fit, only : n_complete, polynomials, &
      fit_polynomial
   use axijoint_base_kinds, only : wp
   use axijoint_fe_extrapolation, only : projection_matrix
   use axijoint_fe_quadrature, only : square_rule, triangle_rule, max_element_points
   use axijoint_fe_reference, only : reference_type
   use axijoint_fe_shape, only : shape_element, n_corners
   use axijoint_model_mesh, only : mesh_type, n_elements, n_nodes
   implicit none
   private
   public :: sampling_type, new_sampling, patches_type, new_patches, patch_work_type
   public :: find_patch, fit_patch, add_rings

   !> Most samples of an element
   integer, parameter :: max_samples = 4
   !> Rings of neighbours that a patch takes at most
   integer, parameter :: max_rings = 3

   !> Where the stresses of one kind of element are best
   type :: sampling_type
      !> Number of samples
      integer :: n = 0
      !> Their natural coordinates
      real(wp) :: position(2, max_samples) = 0.0_wp
      !> Stresses there from those at the integration points, shape (samples, points)
      real(wp) :: matrix(max_samples, max_element_points) = 0.0_wp
      !> Degree of the polynomial that is fitted on a patch, and least number of its elements
      integer :: degree = 0, least_elements = 0
   end type sampling_type

   !> The samples of a mesh, and which elements lie round an element
   type :: patches_type
      !> Sample before the first of each element, shape (elements + 1)
      integer, allocatable :: before(:)
      !> r and z of the samples, shape (2, samples)
      real(wp), allocatable :: position(:, :)
      !> Elements of node i: element(first(i):first(i + 1) - 1)
      integer, allocatable :: first(:), element(:)
   end type patches_type

   !> A fit on a patch, and what it follows from
   type :: fit_type
      !> Degree of the polynomial
      integer :: degree = -1
      !> Coordinates in the patch, of the samples and of the points where it is wanted, shapes (2, samples) and
      !> (2, points), and weights of the samples: rounded, so that they are the same where patches are
      real(wp), allocatable :: place(:, :), wanted(:, :), weight(:)
      !> Values at the points from those at the samples, shape (points, samples)
      real(wp), allocatable :: matrix(:, :)
   end type fit_type

   !> Fits that are kept for other patches that look the same: those of most elements of a regular mesh do
   integer, parameter :: n_kept = 4
   !> Coordinates are rounded to multiples of this, far below what an estimate of errors can tell
   real(wp), parameter :: grain = 2.0_wp**(-30)

   !> What a thread needs to work on patches
   type :: patch_work_type
      !> The patch: the element itself, then its neighbours; the first n are in use
      integer, allocatable :: elements(:)
      integer :: n = 0
      !> Last element whose patch each element was found in
      integer, allocatable :: found_for(:)
      !> Samples of the patch, the first n_samples of which are in use
      integer, allocatable :: samples(:)
      integer :: n_samples = 0
      !> The last fits, the one of the patch, and the one that was kept last
      type(fit_type) :: fits(n_kept)
      integer :: fit = 1, last = 1
   end type patch_work_type

   !> Samples that lie in a strip of this half width – 1 is half an element – know nothing across it: what
   !> differs among them would be taken far beyond them
   real(wp), parameter :: flat = 0.1_wp

   !> Coordinates of a patch
   type :: frame_type
      !> Linear map of r and z to natural coordinates, but for a shift
      real(wp) :: turn(2, 2) = 0.0_wp
      !> Middle of the element of the patch, after the map
      real(wp) :: middle(2) = 0.0_wp
      !> Middle and half widths of the patch, after the map; a huge width leaves a direction out
      real(wp) :: origin(2) = 0.0_wp, half(2) = 1.0_wp
   end type frame_type

contains

   !> Middle of a linear element; 2 x 2 Gauss points of a quadratic quadrilateral; three points
   !> inside a quadratic triangle, whose stresses are linear but for what goes with 1/r
   elemental function new_sampling(reference) result(sampling)
      !> The element
      type(reference_type), intent(in) :: reference
      !> Its samples
      type(sampling_type) :: sampling

      real(wp) :: x(2, max_element_points), w(max_element_points)
      integer :: n_fit

      select case (reference%n_nodes)
      case (3, 4)
         n_fit = 1
         sampling%n = 1
         sampling%degree = 1
         sampling%least_elements = merge(6, 3, reference%n_nodes == 3)
         x(:, 1) = merge(1.0_wp/3.0_wp, 0.0_wp, reference%n_nodes == 3)
      case (6)
         n_fit = 3
         call triangle_rule(2, sampling%n, x, w)
         sampling%degree = 3
         sampling%least_elements = 4
      case default
         n_fit = 4
         call square_rule(2, sampling%n, x, w)
         sampling%degree = 3
         sampling%least_elements = 3
      end select
      associate (n => sampling%n, p => reference%n_points)
         sampling%position(:, :n) = x(:, :n)
         sampling%matrix(:n, :p) = projection_matrix(n_fit, reference%position(:, :p), &
                                                     reference%weight(:p), x(:, :n))
      end associate
   end function new_sampling

   !> Place the samples of a mesh
   pure subroutine new_patches(mesh, samplings, patches)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Samples of each kind of element
      type(sampling_type), intent(in) :: samplings(:)
      !> The patches
      type(patches_type), intent(out) :: patches

      real(wp) :: shape(9, max_samples, size(samplings)), derivative(2, 9), place(2)
      integer :: kind, element, i, k

      do kind = 1, size(samplings)
         do i = 1, samplings(kind)%n
            associate (x => samplings(kind)%position(:, i))
               call shape_element(mesh%kinds(kind)%n_nodes, x(1), x(2), shape(:, i, kind), derivative)
            end associate
         end do
      end do
      allocate (patches%before(n_elements(mesh) + 1))
      patches%before(1) = 0
      do element = 1, n_elements(mesh)
         patches%before(element + 1) = patches%before(element) + &
            samplings(mesh%element_kind(element))%n
      end do
      allocate (patches%position(2, patches%before(n_elements(mesh) + 1)))
      do element = 1, n_elements(mesh)
         kind = mesh%element_kind(element)
         do i = 1, samplings(kind)%n
            place = 0.0_wp
            do k = 1, mesh%element_size(element)
               place = place + shape(k, i, kind)*mesh%coordinates(:, mesh%element_nodes(k, element))
            end do
            patches%position(:, patches%before(element) + i) = place
         end do
      end do
      call list_elements(mesh, patches%first, patches%element)
   end subroutine new_patches

   !> Elements of each node
   pure subroutine list_elements(mesh, first, list)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Elements of node i: list(first(i):first(i + 1) - 1)
      integer, allocatable, intent(out) :: first(:), list(:)

      integer, allocatable :: next(:)
      integer :: element, i

      allocate (first(n_nodes(mesh) + 1), source=0)
      do element = 1, n_elements(mesh)
         associate (nodes => mesh%element_nodes(:mesh%element_size(element), element))
            first(nodes) = first(nodes) + 1
         end associate
      end do
      i = 1
      do element = 1, size(first)  ! from numbers to where they begin
         i = i + first(element)
         first(element) = i - first(element)
      end do
      next = first
      allocate (list(first(size(first)) - 1))
      do element = 1, n_elements(mesh)
         do i = 1, mesh%element_size(element)
            associate (place => next(mesh%element_nodes(i, element)))
               list(place) = element
               place = place + 1
            end associate
         end do
      end do
   end subroutine list_elements

   !> Elements of the same body and material round an element, ring by ring until there are
   !> enough, and their samples
   pure subroutine find_patch(mesh, patches, least_elements, element, work)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Its samples
      type(patches_type), intent(in) :: patches
      !> Elements that a patch should have
      integer, intent(in) :: least_elements
      !> The element
      integer, intent(in) :: element
      !> Takes the patch
      type(patch_work_type), intent(inout) :: work

      integer :: ring, start, last, k, s

      if (.not. allocated(work%found_for)) then
         allocate (work%found_for(n_elements(mesh)), source=0)
         allocate (work%elements(n_elements(mesh)))
      end if
      work%elements(1) = element
      work%n = 1
      work%found_for(element) = element
      start = 1
      do ring = 1, max_rings
         last = work%n
         do k = start, last
            call add_neighbours(mesh, patches, element, work%elements(k), work)
         end do
         if (work%n >= least_elements .or. work%n == last) exit
         start = last + 1
      end do
      work%n_samples = 0
      associate (n => patches%before(work%elements(:work%n) + 1) - &
         patches%before(work%elements(:work%n)))
         call reserve(sum(n), work)
      end associate
      do k = 1, work%n
         do s = patches%before(work%elements(k)) + 1, patches%before(work%elements(k) + 1)
            work%n_samples = work%n_samples + 1
            work%samples(work%n_samples) = s
         end do
      end do
   end subroutine find_patch

   !> Add to a set of elements all that may lie in their patches
   pure subroutine add_rings(mesh, patches, chosen)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Elements of the nodes
      type(patches_type), intent(in) :: patches
      !> The set
      logical, intent(inout) :: chosen(:)

      logical, allocatable :: touched(:)
      integer :: ring, element, node

      allocate (touched(size(patches%first) - 1))
      do ring = 1, max_rings
         if (all(chosen)) return
         touched = .false.
         do element = 1, size(chosen)
            if (chosen(element)) &
               touched(mesh%element_nodes(:mesh%element_size(element), element)) = .true.
         end do
         do node = 1, size(touched)
            if (touched(node)) &
               chosen(patches%element(patches%first(node):patches%first(node + 1) - 1)) = .true.
         end do
      end do
   end subroutine add_rings

   !> Room for samples
   pure subroutine reserve(n, work)
      !> Number of samples
      integer, intent(in) :: n
      !> What takes them
      type(patch_work_type), intent(inout) :: work

      if (allocated(work%samples)) then
         if (size(work%samples) >= n) return
         deallocate (work%samples)
      end if
      allocate (work%samples(2*n))
   end subroutine reserve

   !> Add the neighbours of an element to a patch, but for other materials
   pure subroutine add_neighbours(mesh, patches, element, middle, work)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Elements of the nodes
      type(patches_type), intent(in) :: patches
      !> The element of the patch
      integer, intent(in) :: element
      !> The element whose neighbours are added
      integer, intent(in) :: middle
      !> Takes them
      type(patch_work_type), intent(inout) :: work

      integer :: i, k, node

      do i = 1, mesh%element_size(middle)
         node = mesh%element_nodes(i, middle)
         do k = patches%first(node), patches%first(node + 1) - 1
            associate (other => patches%element(k))
               if (work%found_for(other) == element) cycle
               if (mesh%element_material(other) /= mesh%element_material(element)) cycle
               work%found_for(other) = element
               work%n = work%n + 1
               work%elements(work%n) = other
            end associate
         end do
      end do
   end subroutine add_neighbours

   !> The fit on a patch: the polynomial of least weighted squares at its samples. Near samples
   !> count more than far ones, by the fourth power of the distance
   pure subroutine fit_patch(mesh, patches, degree, element, targets, work)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Its samples
      type(patches_type), intent(in) :: patches
      !> Degree of the polynomial
      integer, intent(in) :: degree
      !> The element of the patch, which has been found
      integer, intent(in) :: element
      !> r and z of the points where the fit is wanted, shape (2, points)
      real(wp), intent(in) :: targets(:, :)
      !> The patch; takes the fit
      type(patch_work_type), intent(inout) :: work

      type(frame_type) :: frame
      type(fit_type) :: fit
      integer :: i, k

      associate (positions => patches%position(:, work%samples(:work%n_samples)))
         frame = new_frame(mesh, element, positions)
         fit%degree = degree
         allocate (fit%place, mold=positions)
         allocate (fit%wanted, mold=targets)
         allocate (fit%weight(work%n_samples))
         do i = 1, work%n_samples
            fit%place(:, i) = rounded(in_frame(frame, positions(:, i)))
            fit%weight(i) = rounded(weight_of(frame, positions(:, i)))
         end do
      end associate
      do i = 1, size(targets, 2)
         fit%wanted(:, i) = rounded(in_frame(frame, targets(:, i)))
      end do
      do k = 1, n_kept
         if (.not. are_alike(fit, work%fits(k))) cycle
         work%fit = k
         return
      end do
      call find_matrix(fit)
      work%last = mod(work%last, n_kept) + 1
      work%fit = work%last
      work%fits(work%last) = fit
   end subroutine fit_patch

   !> A coordinate rounded; a huge one, far outside, as it is
   elemental real(wp) function rounded(x)
      !> The coordinate
      real(wp), intent(in) :: x

      ! numbers as large as this have no digits after the point: what is added to them is rounded to a whole one
      real(wp), parameter :: whole = 1.5_wp/epsilon(1.0_wp)

      rounded = x
      if (abs(x) < 1.0_wp/grain) rounded = ((x/grain + whole) - whole)*grain
   end function rounded

   !> Whether two fits are the same
   pure logical function are_alike(a, b)
      !> The fits
      type(fit_type), intent(in) :: a, b

      are_alike = a%degree == b%degree
      if (are_alike) are_alike = size(a%weight) == size(b%weight) .and. size(a%wanted, 2) == size(b%wanted, 2)
      if (are_alike) are_alike = all(abs(a%weight - b%weight) <= 0.0_wp)
      if (are_alike) are_alike = all(abs(a%place - b%place) <= 0.0_wp) .and. all(abs(a%wanted - b%wanted) <= 0.0_wp)
   end function are_alike

   !> Values at the points that are wanted from those at the samples
   pure subroutine find_matrix(fit)
      !> What the fit follows from; takes the matrix
      type(fit_type), intent(inout) :: fit

      real(wp) :: coefficient(n_complete(fit%degree), size(fit%weight)), at_point(n_complete(fit%degree))
      integer :: i, s

      call fit_polynomial(fit%place, fit%weight, coefficient)
      allocate (fit%matrix(size(fit%wanted, 2), size(fit%weight)))
      do i = 1, size(fit%matrix, 1)
         at_point = polynomials(size(at_point), fit%wanted(:, i))
         do s = 1, size(fit%matrix, 2)
            fit%matrix(i, s) = dot_product(at_point, coefficient(:, s))
         end do
      end do
   end subroutine find_matrix

   !> Coordinates of a patch, in the directions of the natural coordinates of its element: a
   !> patch of long and thin elements is as wide as it is high
   pure function new_frame(mesh, element, position) result(frame)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> r and z of the points of the patch, shape (2, points)
      real(wp), intent(in) :: position(:, :)
      !> The coordinates
      type(frame_type) :: frame

      real(wp) :: low(2), high(2), x(2)
      integer :: i

      frame%turn = to_natural(mesh, element)
      frame%middle = matmul(frame%turn, middle_of(mesh, element))
      low = huge(low)
      high = -huge(high)
      do i = 1, size(position, 2)
         x = matmul(frame%turn, position(:, i))
         low = min(low, x)
         high = max(high, x)
      end do
      frame%origin = 0.5_wp*(low + high)
      frame%half = 0.5_wp*(high - low)
      where (.not. frame%half > flat) frame%half = huge(flat)
   end function new_frame

   !> Coordinates of a point in a patch, within -1 and 1; 0 in a direction that is left out
   pure function in_frame(frame, position) result(x)
      !> The patch
      type(frame_type), intent(in) :: frame
      !> r and z
      real(wp), intent(in) :: position(2)
      !> The coordinates
      real(wp) :: x(2)

      x = (matmul(frame%turn, position) - frame%origin)/frame%half
   end function in_frame

   !> Weight of a point in a patch
   pure real(wp) function weight_of(frame, position)
      !> The patch
      type(frame_type), intent(in) :: frame
      !> r and z
      real(wp), intent(in) :: position(2)

      weight_of = 1.0_wp/(1.0_wp + sum((matmul(frame%turn, position) - frame%middle)**2))**2
   end function weight_of

   !> Middle of the corners of an element
   pure function middle_of(mesh, element) result(middle)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> r and z
      real(wp) :: middle(2)

      integer :: n

      n = n_corners(mesh%element_size(element))
      middle = sum(mesh%coordinates(:, mesh%element_nodes(:n, element)), 2)/n
   end function middle_of

   !> Linear map that takes r and z to natural coordinates of an element: a patch of long and
   !> thin elements is as wide as it is high
   pure function to_natural(mesh, element) result(turn)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> The map, but for a shift
      real(wp) :: turn(2, 2)

      real(wp) :: shape(9), derivative(2, 9), jacobian(2, 2), middle
      integer :: n

      n = mesh%element_size(element)
      middle = merge(1.0_wp/3.0_wp, 0.0_wp, n_corners(n) == 3)
      call shape_element(n, middle, middle, shape, derivative)
      jacobian = matmul(mesh%coordinates(:, mesh%element_nodes(:n, element)), &
         transpose(derivative(:, :n)))
      turn = reshape([jacobian(2, 2), -jacobian(2, 1), -jacobian(1, 2), jacobian(1, 1)], [2, 2]) &
         /(jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1))
   end function to_natural

end module axijoint_analysis_error_patch_recovery
