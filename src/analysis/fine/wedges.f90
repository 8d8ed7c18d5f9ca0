!> Wedges that elements form at nodes: parts of elements that are bonded, one after the other round a node
module axijoint_analysis_fine_wedges
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, find_edge, n_on
   use axijoint_base_kinds, only : wp, pi
   use axijoint_base_sort, only : ascending_order
   use axijoint_element_wedge, only : wedge_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: sector_type, wedges_type, divide

   !> Angles that differ by less count as the same: curved sides are cut into straight ones [radian]
   real(wp), parameter :: same = 10.0_wp*pi/180.0_wp
   !> A wedge is compared with so many of those before
   integer, parameter :: looked_back = 8
   !> Angles that differ by no more are those of one wedge [radian]
   real(wp), parameter :: rounding = 1.0e-10_wp
   !> Sectors follow each other if no larger angle is left between them [radian]
   real(wp), parameter :: closing = 1.0e-6_wp

   !> Part of an element at one of its corners
   type :: sector_type
      !> Node and element
      integer :: node = 0, element = 0
      !> Nodes at the other ends of its sides, counterclockwise
      integer :: ends(2) = 0
      !> Angles of its sides, ascending [radian]
      real(wp) :: from = 0.0_wp, to = 0.0_wp
      !> Whether nothing holds the side: it is an outer one without a joint, or its joint can open
      !> or is so soft that it counts as open
      logical :: opens(2) = .false.
   end type sector_type

   !> Wedges at all nodes. Along a boundary of two materials one is like the next
   type :: wedges_type
      !> Wedges that differ from those before, and how many there are
      type(wedge_type), allocatable :: different(:)
      integer :: n = 0
      !> Nodes at tips, with the places of their wedges, shape (2, any), and how many there are
      integer, allocatable :: tip(:, :)
      integer :: n_tips = 0
   end type wedges_type

contains

   !> Divide the sectors at a node into wedges; none where a material is not isotropic
   subroutine divide(model, fine, sectors, node, open, wedges)
      !> The job
      type(model_type), intent(in) :: model
      !> Edges of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> The sectors
      type(sector_type), intent(in) :: sectors(:)
      !> The node
      integer, intent(in) :: node
      !> Whether joints that can open are open
      logical, intent(in) :: open
      !> Takes those that could make stresses infinite
      type(wedges_type), intent(inout) :: wedges

      type(sector_type), allocatable :: sorted(:)
      type(wedge_type) :: wedge
      integer :: first, last, n

      if (is_inside(model, sectors)) return
      if (any(model%materials(model%mesh%element_material(sectors%element))%orthotropic)) return
      n = size(sectors)
      sorted = sectors
      sorted%to = sorted%to - sorted%from
      sorted%from = modulo(sorted%from, 2.0_wp*pi)
      sorted%to = sorted%to + sorted%from
      sorted = sorted(ascending_order((sorted%from)))
      if (.not. open) then
         sorted%opens(1) = .false.
         sorted%opens(2) = .false.
      end if
      sorted = cshift(sorted, start_of(sorted) - 1)
      do first = 2, n  ! ascending beyond a full turn
         if (sorted(first)%from >= sorted(first - 1)%from) cycle
         sorted(first:)%from = sorted(first:)%from + 2.0_wp*pi
         sorted(first:)%to = sorted(first:)%to + 2.0_wp*pi
      end do
      first = 1
      do while (first <= n)
         last = first
         do while (last < n)
            if (.not. follows(sorted(last), sorted(last + 1))) exit
            last = last + 1
         end do
         wedge = wedge_of(model, fine, sorted(first:last))
         if (.not. is_smooth(wedge)) call take_wedge(wedge, node, wedges)
         first = last + 1
      end do
   end subroutine divide

   !> Whether sectors of one material fill the circle round a node: most do
   pure logical function is_inside(model, sectors) result(inside)
      !> The job
      type(model_type), intent(in) :: model
      !> The sectors
      type(sector_type), intent(in) :: sectors(:)

      real(wp) :: angle
      integer :: k

      inside = .false.
      angle = 0.0_wp
      do k = 1, size(sectors)
         if (any(sectors(k)%opens)) return
         if (model%mesh%element_material(sectors(k)%element) /= model%mesh%element_material(sectors(1)%element)) return
         angle = angle + sectors(k)%to - sectors(k)%from
      end do
      inside = abs(angle - 2.0_wp*pi) < closing
   end function is_inside

   !> Take the wedge of a node
   subroutine take_wedge(wedge, node, wedges)
      !> The wedge
      type(wedge_type), intent(in) :: wedge
      !> The node
      integer, intent(in) :: node
      !> Takes both
      type(wedges_type), intent(inout) :: wedges

      type(wedge_type), allocatable :: more(:)
      integer, allocatable :: tip(:, :)
      integer :: k

      if (.not. allocated(wedges%tip)) allocate (wedges%different(looked_back), wedges%tip(2, looked_back))
      do k = wedges%n, max(1, wedges%n - looked_back + 1), -1
         if (are_alike(wedge, wedges%different(k))) exit
      end do
      if (k < max(1, wedges%n - looked_back + 1)) then
         if (wedges%n == size(wedges%different)) then
            allocate (more(2*wedges%n))
            more(:wedges%n) = wedges%different
            call move_alloc(more, wedges%different)
         end if
         wedges%n = wedges%n + 1
         k = wedges%n
         wedges%different(k) = wedge
      end if
      if (wedges%n_tips == size(wedges%tip, 2)) then
         allocate (tip(2, 2*wedges%n_tips))
         tip(:, :wedges%n_tips) = wedges%tip
         call move_alloc(tip, wedges%tip)
      end if
      wedges%n_tips = wedges%n_tips + 1
      wedges%tip(:, wedges%n_tips) = [node, k]
   end subroutine take_wedge

   !> Whether two wedges have the same exponents
   pure logical function are_alike(a, b)
      !> The wedges
      type(wedge_type), intent(in) :: a, b

      are_alike = size(a%young) == size(b%young) .and. (a%closed .eqv. b%closed) .and. all(a%held .eqv. b%held)
      if (are_alike) are_alike = all(abs(a%young - b%young) <= 0.0_wp) .and. &
         all(abs(a%poisson - b%poisson) <= 0.0_wp) .and. all(abs(a%ray - b%ray) <= rounding)
   end function are_alike

   !> Place of a sector before which there is a gap; 1 if there is none
   pure integer function start_of(sectors) result(place)
      !> Sectors in the order of their angles
      type(sector_type), intent(in) :: sectors(:)

      do place = 1, size(sectors)
         if (.not. follows(sectors(modulo(place - 2, size(sectors)) + 1), sectors(place))) return
      end do
      place = 1
   end function start_of

   !> Whether a sector begins where another ends, and nothing opens between them
   pure logical function follows(before, after)
      !> The sectors
      type(sector_type), intent(in) :: before, after

      follows = abs(modulo(after%from - before%to + pi, 2.0_wp*pi) - pi) < closing &
         .and. .not. (before%opens(2) .or. after%opens(1))
   end function follows

   !> The wedge of some sectors
   function wedge_of(model, fine, sectors) result(wedge)
      !> The job
      type(model_type), intent(in) :: model
      !> Edges of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Its sectors, one after the other
      type(sector_type), intent(in) :: sectors(:)
      !> The wedge
      type(wedge_type) :: wedge

      integer :: k, n, now, before

      n = size(sectors)
      allocate (wedge%ray(1), wedge%young(0), wedge%poisson(0))
      wedge%ray = sectors(1)%from
      before = 0
      do k = 1, n
         now = model%mesh%element_material(sectors(k)%element)
         if (now == before) then
            wedge%ray(size(wedge%ray)) = sectors(k)%to
         else
            wedge%ray = [wedge%ray, sectors(k)%to]
            wedge%young = [wedge%young, model%materials(now)%young]
            wedge%poisson = [wedge%poisson, model%materials(now)%poisson]
         end if
         before = now
      end do
      wedge%closed = follows(sectors(n), sectors(1))
      if (.not. wedge%closed) then
         wedge%held(:, 1) = held_along(sectors(1)%node, sectors(1)%ends(1))
         wedge%held(:, 2) = held_along(sectors(n)%node, sectors(n)%ends(2))
      end if

   contains

      !> Components that are held along a side. On the axis those along r and theta are tied: one holds both
      pure function held_along(node, end) result(held)
         !> Nodes at its ends
         integer, intent(in) :: node, end
         !> r, z, theta
         logical :: held(3)

         logical :: there(3)
         integer :: k

         held = .true.
         associate (edge => fine%edges(find_edge(fine, node, end)))
            do k = 1, n_on(edge)
               there = model%fixed(:, edge%nodes(k))
               if (.not. model%mesh%coordinates(1, edge%nodes(k)) > 0.0_wp) there([1, 3]) = any(there([1, 3]))
               held = held .and. there
            end do
         end associate
      end function held_along

   end function wedge_of

   !> Whether there is nothing that could make stresses infinite
   pure logical function is_smooth(wedge)
      !> The wedge
      type(wedge_type), intent(in) :: wedge

      associate (angle => wedge%ray(size(wedge%ray)) - wedge%ray(1), n => size(wedge%young))
         if (wedge%closed) then
            is_smooth = n == 1
            if (n == 2) is_smooth = abs(wedge%ray(2) - wedge%ray(1) - pi) < same
         else
            is_smooth = n == 1 .and. angle < pi + same &
               .and. all(wedge%held(:, 1) .eqv. wedge%held(:, 2))
            ! square corners between a face that is held along one direction and a free one mirror
            ! half of a body
            if (n == 1 .and. angle < 0.5_wp*pi + same .and. .not. any(all(wedge%held(:2, :), 1))) &
               is_smooth = .true.
         end if
      end associate
   end function is_smooth

end module axijoint_analysis_fine_wedges
