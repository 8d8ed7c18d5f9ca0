!> Fourier modes that a job needs
module axijoint_model_modes
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_law, only : yield_none
   use axijoint_fe_mode, only : mode_type, same_mode, family_symmetric, family_antisymmetric
   use axijoint_model_model, only : model_type, can_yield, bodies_yield
   implicit none
   private
   public :: used_modes, is_loaded, highest_loaded, greatest_divisor

contains

   !> Modes to solve, ascending, the symmetric before the antisymmetric; at least
   !> one. A linear job needs the loaded ones only. Opening, slip and yielding couple
   !> the harmonics, but what repeats g times round the circle stays so: only
   !> multiples of g = gcd of the loaded harmonics are excited, and of these only odd multiples
   !> where loads of no others meet bodies that yield alike under a stress and its opposite: then
   !> all changes sign with the turn by pi/g that turns the loads round. One family stays
   !> alone if the loads are symmetric; under antisymmetric loads, what yields answers
   !> in both.
   pure function used_modes(model) result(modes)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), allocatable :: modes(:)

      type(mode_type), allocatable :: loaded(:)
      integer, allocatable :: harmonics(:)
      integer :: k, g

      loaded = loaded_modes(model)
      if (.not. (can_yield(model) .or. bodies_yield(model))) then
         modes = loaded
      else
         g = 0
         do k = 1, size(loaded)
            g = greatest_divisor(g, loaded(k)%harmonic)
         end do
         if (g == 0) then
            harmonics = pack(model%harmonics, model%harmonics == 0)
         else
            harmonics = pack(model%harmonics, mod(model%harmonics, g) == 0)
            if (all(mod(loaded%harmonic/g, 2) == 1) .and. knows_no_sign(model)) &
               harmonics = pack(harmonics, mod(harmonics/g, 2) == 1)
         end if
         if (any(loaded%family == family_antisymmetric)) then
            modes = [(mode_type(harmonics(k), family_symmetric), &
                      mode_type(harmonics(k), family_antisymmetric), k=1, size(harmonics))]
         else
            modes = [(mode_type(harmonics(k), family_symmetric), k=1, size(harmonics))]
         end if
      end if
      if (size(modes) == 0) modes = [mode_type(model%harmonics(1), family_symmetric)]
   end function used_modes

   !> Whether all that yields does so alike under a stress and its opposite: no joint that opens or
   !> slips, no criterion with friction or a tension cut-off
   pure logical function knows_no_sign(model)
      !> The job
      type(model_type), intent(in) :: model

      associate (laws => model%materials%yield)
         knows_no_sign = .not. can_yield(model) .and. all(laws%criterion == yield_none .or. &
            (.not. laws%friction > 0.0_wp .and. .not. laws%tension < huge(1.0_wp)))
      end associate
   end function knows_no_sign

   !> Highest harmonic that any load is given in; 0 if there is none
   pure integer function highest_loaded(model)
      !> The job
      type(model_type), intent(in) :: model

      type(mode_type), allocatable :: loaded(:)

      loaded = loaded_modes(model)
      highest_loaded = max(0, maxval(loaded%harmonic))
   end function highest_loaded

   !> Modes that any load is given in, ascending
   pure function loaded_modes(model) result(modes)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), allocatable :: modes(:)

      type(mode_type) :: mode
      integer :: k, family

      allocate (modes(0))
      do k = 1, size(model%harmonics)
         do family = family_symmetric, family_antisymmetric
            mode = mode_type(model%harmonics(k), family)
            if (is_loaded(model, mode)) modes = [modes, mode]
         end do
      end do
   end function loaded_modes

   !> Whether any load is given in a mode
   pure logical function is_loaded(model, mode)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode

      is_loaded = any(same_mode(model%edge_loads%mode, mode)) &
         .or. any(same_mode(model%ring_loads%mode, mode)) &
         .or. any(same_mode(model%body_loads%mode, mode)) &
         .or. any(same_mode(model%thermal_loads%mode, mode)) &
         .or. any(same_mode(model%prescribed%mode, mode) .and. abs(model%prescribed%value) > 0.0) &
         .or. size(model%initial_stresses) > 0 .and. same_mode(mode, mode_type(0, family_symmetric))
   end function is_loaded

   !> Greatest common divisor; that of zero and n is n
   pure recursive integer function greatest_divisor(a, b) result(g)
      !> Not negative
      integer, intent(in) :: a, b

      if (b == 0) then
         g = a
      else
         g = greatest_divisor(b, mod(a, b))
      end if
   end function greatest_divisor

end module axijoint_model_modes
