!> Loads and constraints of NASTRAN's decks for solids of revolution, as amplitudes of harmonics
module axijoint_legacy_nastran_loads
   use axijoint_base_kinds, only : wp, pi, degree
   use axijoint_base_number_map, only : number_map_type, find_number
   use axijoint_base_text, only : to_text
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : list_type, add
   use axijoint_legacy_nastran_cards, only : entry_type, next_entry, integer_in, real_in, is_in, &
      fault_in
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_restraints, part_chains, part_tractions, &
      part_ring_loads, part_gravity, part_moved
   use axijoint_legacy_words, only : put, exact
   implicit none
   private
   public :: case_type, gather_sets, add_pressure, add_force, add_gravity, add_constraint, hold

   !> What is asked for, and what later entries refer to
   type :: case_type
      !> Sets that case control names
      integer :: load = 0, constraint = 0
      !> The subcase that is translated, the first; how many there are
      character(len=:), allocatable :: subcase
      integer :: n_subcases = 0
      !> Whether series are symmetric to phi = 0 (COSINE), or antisymmetric (SINE)
      logical :: symmetric = .true.
      !> Sets that act, and factors of the sets of loads
      type(list_type) :: loads, constraints
      real(wp), allocatable :: factor(:)
      !> Rings by number: their places
      type(number_map_type) :: rings
      real(wp), allocatable :: position(:, :)
      integer :: n_rings = 0
      !> Properties by number: their materials
      type(number_map_type) :: properties
      integer, allocatable :: material(:)
      integer :: n_materials = 0
      !> Numbers of MAT1, and of elements
      type(number_map_type) :: materials, elements
      !> Faces so far
      integer :: n_faces = 0
   end type case_type

contains

   !> Which sets act: those that case control names, and what LOAD and SPCADD put together
   subroutine gather_sets(cards, bulk, case)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The card BEGIN BULK
      integer, intent(in) :: bulk
      !> What is asked for
      type(case_type), intent(inout) :: case

      type(entry_type) :: entry
      real(wp) :: factor
      integer :: at, k

      allocate (case%factor(0))
      allocate (case%loads%value(8), case%constraints%value(8), source=0)
      if (case%load > 0) call add(case%loads, case%load)
      if (case%load > 0) case%factor = [1.0_wp]
      if (case%constraint > 0) call add(case%constraints, case%constraint)
      at = bulk
      do
         call next_entry(cards, at, entry)
         if (entry%name == '') exit
         if (entry%name == 'SPCADD') then
            if (integer_in(cards, entry, 2, 0) /= case%constraint) cycle
            do k = 3, entry%n + 1
               if (is_in(entry, k)) call add(case%constraints, integer_in(cards, entry, k, 0))
            end do
         else if (entry%name == 'LOAD') then
            if (integer_in(cards, entry, 2, 0) /= case%load) cycle
            factor = real_in(cards, entry, 3, 1.0_wp)
            do k = 4, entry%n, 2
               if (.not. is_in(entry, k + 1)) cycle
               call add(case%loads, integer_in(cards, entry, k + 1, 0))
               case%factor = [case%factor, factor*real_in(cards, entry, k, 1.0_wp)]
            end do
         end if
      end do
   end subroutine gather_sets

   !> Factor of the set of loads that an entry belongs to; 0 if it does not act
   real(wp) function factor_of(cards, entry, case) result(factor)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> Which sets act
      type(case_type), intent(in) :: case

      integer :: k, set

      set = integer_in(cards, entry, 2, 0)
      factor = 0.0_wp
      do k = 1, case%loads%n
         if (case%loads%value(k) == set) factor = factor + case%factor(k)
      end do
   end function factor_of

   !> Whether a set that an entry belongs to acts; it is noted if not
   logical function acts(cards, entry, case, sets, sketch)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> What is asked for
      type(case_type), intent(in) :: case
      !> The sets that act: its loads, or its constraints
      type(list_type), intent(in) :: sets
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      character(len=:), allocatable :: who

      acts = any(sets%value(:sets%n) == integer_in(cards, entry, 2, 0))
      if (acts) return
      who = 'case control'
      if (case%n_subcases > 1) who = case%subcase//', the subcase that is translated,'
      call leave_out(sketch, entry%first, entry%name//' of a set that '//who//' does not choose')
   end function acts

   !> S or A
   pure character(len=1) function family(case)
      !> Whether series are symmetric
      type(case_type), intent(in) :: case

      family = merge('S', 'A', case%symmetric)
   end function family

   !> PRESAX: a pressure between two rings and two angles, in all harmonics. It acts to the right of
   !> the way from the first ring to the second
   subroutine add_pressure(cards, entry, case, sketch)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> What acts
      type(case_type), intent(inout) :: case
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      real(wp) :: pressure, from, to, direction(2), amplitude
      integer :: nodes(2), rings(2), k, m

      pressure = factor_of(cards, entry, case)*real_in(cards, entry, 3, 0.0_wp)
      if (.not. acts(cards, entry, case, case%loads, sketch)) return
      do k = 1, 2
         nodes(k) = integer_in(cards, entry, 3 + k, 0)
         rings(k) = find_number(case%rings, nodes(k))
         if (rings(k) == 0) call fault_in(cards, entry, 3 + k, 'there is no such ring', 'RINGAX')
      end do
      if (any(rings == 0)) return
      direction = case%position(:, rings(2)) - case%position(:, rings(1))
      if (.not. norm2(direction) > 0.0_wp) then
         call fault_in(cards, entry, 5, 'both rings are at one place')
         return
      end if
      direction = [direction(2), -direction(1)]/norm2(direction)
      from = degree*real_in(cards, entry, 6, 0.0_wp)
      to = degree*real_in(cards, entry, 7, 360.0_wp)
      if (.not. to > from) then
         call fault_in(cards, entry, 7, 'the second angle is not above the first', 'PHI1 < PHI2, such as 330 and 390 degrees')
         return
      end if
      case%n_faces = case%n_faces + 1
      call put(sketch%parts(part_chains), to_text(case%n_faces)//', '//to_text(nodes(1))//', '// &
         to_text(nodes(2)))
      do m = 0, sketch%harmonic
         amplitude = pressure*coefficient(m, from, to, case%symmetric)
         if (abs(amplitude) > 1.0e-14_wp*abs(pressure)) call put(sketch%parts(part_tractions), &
            to_text(case%n_faces)//', '//to_text(m)//', '//exact(amplitude*direction(1))//', '// &
            exact(amplitude*direction(2))//', , , , , '//family(case))
      end do
   end subroutine add_pressure

   !> Fourier coefficient of what is one between two angles, and zero elsewhere
   pure real(wp) function coefficient(m, from, to, symmetric)
      !> Harmonic
      integer, intent(in) :: m
      !> The angles [radian]
      real(wp), intent(in) :: from, to
      !> Whether of the cosine, or of the sine
      logical, intent(in) :: symmetric

      if (m == 0) then
         coefficient = merge(0.5_wp*(to - from)/pi, 0.0_wp, symmetric)
      else if (symmetric) then
         coefficient = (sin(m*to) - sin(m*from))/(m*pi)
      else
         coefficient = (cos(m*from) - cos(m*to))/(m*pi)
      end if
   end function coefficient

   !> FORCEAX: generalized forces of a ring in harmonics, whose work on an amplitude of one they are
   subroutine add_force(cards, entry, case, sketch, known)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> What acts
      type(case_type), intent(in) :: case
      !> The new deck
      type(sketch_type), intent(inout) :: sketch
      !> Whether it is translated
      logical, intent(out) :: known

      real(wp) :: force(3), length, around
      integer :: ring, first, last, m, k

      known = .true.
      force = factor_of(cards, entry, case)*real_in(cards, entry, 5, 1.0_wp)
      if (.not. acts(cards, entry, case, case%loads, sketch)) return
      do k = 1, 3
         force(k) = force(k)*real_in(cards, entry, 5 + k, 0.0_wp)
      end do
      ring = find_number(case%rings, integer_in(cards, entry, 3, 0))
      if (ring == 0) call fault_in(cards, entry, 3, 'there is no such ring', 'RINGAX')
      call harmonics_in(cards, entry, 4, sketch%harmonic, first, last)
      if (ring == 0 .or. first > last) return
      known = case%symmetric .or. first > 0  ! torsion
      if (.not. known) return
      if (.not. case%position(1, ring) > 0.0_wp) then
         call add_axis_force(entry, integer_in(cards, entry, 3, 0), force, first, last, sketch)
         return
      end if
      do m = first, last
         length = merge(2.0_wp, 1.0_wp, m == 0)*pi*case%position(1, ring)
         around = force(2)
         if (m == 0 .and. abs(around) > 0.0_wp) then
            around = 0.0_wp
            call leave_out(sketch, entry%first, entry%name//' of FP in harmonic 0, which is torsion')
         end if
         call put(sketch%parts(part_ring_loads), to_text(integer_in(cards, entry, 3, 0))//', '// &
            to_text(m)//', '//exact(force(1)/length)//', '//exact(force(3)/length)//', '// &
            exact(around/length)//', '//family(case))
      end do
   end subroutine add_force

   !> FORCEAX on the axis, where the ring is a point: the force along it in harmonic 0 alone
   subroutine add_axis_force(entry, ring, force, first, last, sketch)
      !> The entry
      type(entry_type), intent(in) :: entry
      !> Number of the ring
      integer, intent(in) :: ring
      !> FR, FP, FZ
      real(wp), intent(in) :: force(3)
      !> Harmonics
      integer, intent(in) :: first, last
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      if (first == 0 .and. abs(force(3)) > 0.0_wp) call put(sketch%parts(part_ring_loads), &
         to_text(ring)//', 0, , '//exact(force(3)))
      if (last > 0 .or. any(abs(force(:2)) > 0.0_wp)) call leave_out(sketch, entry%first, &
         entry%name//' on the axis, but for FZ in harmonic 0')
   end subroutine add_axis_force

   !> Harmonics in a field: one, or a sequence SnTm; first > last after an error
   subroutine harmonics_in(cards, entry, field, highest, first, last)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> The field
      integer, intent(in) :: field
      !> The highest harmonic of the deck
      integer, intent(in) :: highest
      !> The harmonics
      integer, intent(out) :: first, last

      character(len=:), allocatable :: text
      integer :: fault, t

      text = trim(entry%text(field - 1))
      fault = 1
      t = index(text, 'T')
      if (index(text, 'S') == 1 .and. t > 2 .and. t < len(text)) then
         read (text(2:t - 1), *, iostat=fault) first
         if (fault == 0) read (text(t + 1:), *, iostat=fault) last
      else if (len(text) > 0) then
         read (text, *, iostat=fault) first
         last = first
      end if
      if (fault == 0) then
         if (first < 0 .or. first > last .or. last > highest) fault = 1
      end if
      if (fault == 0) return
      call fault_in(cards, entry, field, 'this is no harmonic', '0 to H of AXIC, or a sequence SnTm')
      first = 1
      last = 0
   end subroutine harmonics_in

   !> GRAV along the axis
   subroutine add_gravity(cards, entry, case, sketch, known)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> What acts
      type(case_type), intent(in) :: case
      !> The new deck
      type(sketch_type), intent(inout) :: sketch
      !> Whether it is translated
      logical, intent(out) :: known

      real(wp) :: g, lateral(2)

      known = .true.
      g = factor_of(cards, entry, case)*real_in(cards, entry, 4, 0.0_wp)
      if (.not. acts(cards, entry, case, case%loads, sketch)) return
      if (integer_in(cards, entry, 3, 0) /= 0) then
         call leave_out(sketch, entry%first, 'GRAV in coordinate system '//to_text(integer_in(cards, entry, 3, 0)))
         return
      end if
      lateral(1) = real_in(cards, entry, 5, 0.0_wp)
      lateral(2) = real_in(cards, entry, 6, 0.0_wp)
      known = case%symmetric .and. .not. any(abs(lateral) > 0.0_wp)
      if (known) call put(sketch%parts(part_gravity), exact(g*real_in(cards, entry, 7, 0.0_wp)))
   end subroutine add_gravity

   !> SPCAX: held in a harmonic, at a value
   subroutine add_constraint(cards, entry, case, sketch, known)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> What acts
      type(case_type), intent(in) :: case
      !> The new deck
      type(sketch_type), intent(inout) :: sketch
      !> Whether it is translated
      logical, intent(out) :: known

      integer, parameter :: columns(3) = [1, 3, 2]
      character(len=32) :: values(3)
      real(wp) :: value
      integer :: ring, first, last, m, k

      known = .true.
      if (.not. acts(cards, entry, case, case%constraints, sketch)) return
      ring = integer_in(cards, entry, 3, 0)
      if (find_number(case%rings, ring) == 0) then
         call fault_in(cards, entry, 3, 'there is no such ring', 'RINGAX')
         return
      end if
      call harmonics_in(cards, entry, 4, sketch%harmonic, first, last)
      if (first > last) return
      value = real_in(cards, entry, 6, 0.0_wp)
      if (.not. abs(value) > 0.0_wp) then
         call hold(cards, entry, 5, ring, ', , , '//to_text(first)//', '//to_text(last)//', '// &
            family(case), sketch)
         return
      end if
      known = case%symmetric .or. first > 0  ! torsion
      if (.not. known) return
      if (.not. is_in(entry, 5) .or. verify(trim(entry%text(4)), '123456') > 0) then
         call fault_in(cards, entry, 5, 'these are no components', 'digits from 1 to 6')
         return
      end if
      ! components 1, 2, 3 are along r, phi, z
      values = ''
      do k = 1, 3
         if (index(entry%text(4), to_text(k)) > 0) values(columns(k)) = exact(value)
      end do
      if (all(values == '')) call leave_out(sketch, entry%first, entry%name// &
         ' of a rotation, which solids have none of')
      if (first == 0 .and. values(3) /= '') call leave_out(sketch, entry%first, entry%name// &
         ' of component 2 in harmonic 0, which is torsion')
      do m = first, last
         if (m == 0 .and. all(values(:2) == '')) cycle
         if (all(values == '')) exit
         call put(sketch%parts(part_moved), to_text(ring)//', '//to_text(m)//', '// &
            trim(values(1))//', '//trim(values(2))//', '// &
            trim(merge(repeat(' ', len(values)), values(3), m == 0))//', '//family(case)//', , , ONLY')
      end do
   end subroutine add_constraint

   !> A restraint by the digits of components: 1, 2, 3 along r, phi, z; rotations, which solids have
   !> none of, do not count
   subroutine hold(cards, entry, field, ring, behind, sketch)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> Its field
      integer, intent(in) :: field
      !> Number of the ring
      integer, intent(in) :: ring
      !> What follows on the new card
      character(len=*), intent(in) :: behind
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      character(len=:), allocatable :: digits
      character(len=3) :: code

      digits = trim(entry%text(field - 1))
      if (verify(digits, '123456') > 0) then
         call fault_in(cards, entry, field, 'these are no components', 'digits from 1 to 6')
         return
      end if
      code = merge('1', '0', index(digits, '1') > 0)//merge('1', '0', index(digits, '3') > 0)// &
         merge('1', '0', index(digits, '2') > 0)
      if (code /= '000') call put(sketch%parts(part_restraints), to_text(ring)//', '//code//behind)
   end subroutine hold

end module axijoint_legacy_nastran_loads
