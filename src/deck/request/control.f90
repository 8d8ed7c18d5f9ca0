!> The job's control data: harmonics, planes, increments, angles of the listing
module axijoint_deck_request_control
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error
   use axijoint_fe_element_kind, only : kind_choice_type
   use axijoint_model_load, only : increment_type
   use axijoint_model_model, only : model_type, can_yield
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_registry, only : known_solvers
   implicit none
   private
   public :: read_control, check_planes, field_harmonic, field_planes, field_method

   !> Fields of CONTROL
   integer, parameter :: field_harmonic = 1, field_planes = 2, field_linear = 3, field_quadratic = 4, &
      field_solver = 5, field_formulation = 6, field_method = 7
   !> Angles of the listing unless OUTPUT gives others [degree]
   real(wp), parameter :: default_angles(3) = [0.0_wp, 90.0_wp, 180.0_wp]
   !> Most iterations of an increment unless the deck gives another number
   integer, parameter :: default_iterations = 500

contains

   !> Read CONTROL, INCREMENTS and OUTPUT
   subroutine read_control(control, increments, output, model, choice)
      !> The sections
      type(table_type), intent(in) :: control, increments, output
      !> The job; its control data are set as far as they are valid
      type(model_type), intent(inout) :: model
      !> Rules and formulation of the elements
      type(kind_choice_type), intent(out) :: choice

      type(solver_entry_type), allocatable :: solvers(:)
      integer :: entry, word

      if (control%n > 0) then
         model%max_harmonic = integer_value(control, field_harmonic, 1)
         model%n_planes = integer_value(control, field_planes, 1)
         choice = kind_choice_type(integer_value(control, field_linear, 1), integer_value(control, field_quadratic, 1), &
                                   integer_value(control, field_formulation, 1))
         solvers = known_solvers()
         word = integer_value(control, field_solver, 1)  ! the first one leaves the choice to the program
         if (word > 1) model%solver = solvers(word - 1)
         model%method = integer_value(control, field_method, 1)
      end if
      if (model%n_planes == 0) model%n_planes = max(2, 4*model%max_harmonic + 1)
      model%increments = [(increment_type(increments%values(1, entry), increments%values(2, entry), &
                                          integer_value(increments, 3, entry)), entry=1, increments%n)]
      if (increments%n == 0) model%increments = [increment_type(max_iterations=default_iterations)]
      model%output_angles = degree*pack(output%values(:, :output%n), output%given(:, :output%n))
      if (output%n == 0) model%output_angles = degree*default_angles
   end subroutine read_control

   !> Check that there are planes enough for joints that can open or slip
   subroutine check_planes(source, control, model, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> CONTROL
      type(table_type), intent(in) :: control
      !> The job
      type(model_type), intent(in) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      if (.not. can_yield(model) .or. model%n_planes > model%max_harmonic) return
      call field_error(diagnostics, source, control, 1, field_planes, &
                       'there are too few planes for harmonics up to '//to_text(model%max_harmonic), &
                       allowed='at least M + 1 = '//to_text(model%max_harmonic + 1)// &
                          ' planes where joints can open or slip', &
                       mend='leave the field blank: the default is 4 M + 1')
   end subroutine check_planes

end module axijoint_deck_request_control
