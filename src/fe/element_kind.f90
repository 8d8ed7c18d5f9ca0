!> Kinds of solid elements: number of nodes, integration rule, formulation
module axijoint_fe_element_kind
   implicit none
   private
   public :: element_kind_type, element_kind, kind_choice_type, chosen_kind, find_kind
   public :: formulation_type, formulations, formulation_names, formulation_plain, formulation_bbar
   public :: is_reduced, locks, full_order, reduced_hint

   !> What an element takes for its strains
   type :: formulation_type
      !> Name on cards
      character(len=5) :: name = ''
      !> In words; nothing to say of the strains of the displacements themselves
      character(len=32) :: title = ''
      !> Whether it is there for elements of 3 to 9 nodes; others stay plain
      logical :: offered(3:9) = .false.
      !> Whether elements of 3 to 9 nodes are much too stiff if they can hardly change their volume
      logical :: locks(3:9) = .false.
   end type formulation_type

   logical, parameter, private :: yes = .true., no = .false.
   !> Places in the list
   integer, parameter :: formulation_plain = 1, formulation_bbar = 2
   !> All formulations; `element/solid.f90` has what each does
   type(formulation_type), parameter :: formulations(2) = [ &
      formulation_type('PLAIN', '', [yes, yes, no, yes, no, yes, yes], &
      [yes, yes, no, no, no, no, no]), &
      formulation_type('BBAR', 'mean volumetric strain (B-bar)', [no, yes, no, no, no, no, no])]
   !> Their names
   character(len=5), parameter :: formulation_names(size(formulations)) = formulations%name
   !> Order of the full rule of quadratic elements; what is less is the reduced rule
   integer, parameter :: full_order = 3
   !> What to ask where a structure with such elements is not stiff
   character(len=*), parameter :: reduced_hint = 'the reduced rule (2 in columns 16-20 of CONTROL) leaves some '// &
      'motions of 8- and 9-node elements without stiffness: is it better with 3?'

   !> A kind of element
   type :: element_kind_type
      !> Number of nodes: 3, 4, 6, 8 or 9
      integer :: n_nodes = 0
      !> Order of the rule: Gauss points in each direction of a quadrilateral, 2 or 3; 3 or 7 points
      !> of a triangle
      integer :: order = 0
      !> One of the formulations
      integer :: formulation = formulation_plain
   end type element_kind_type

   !> Rules and formulation of all elements of a job, or of some
   type :: kind_choice_type
      !> Orders of the rules of linear and of quadratic elements
      integer :: order_linear = 2, order_quadratic = full_order
      !> Formulation of those that it is offered for
      integer :: formulation = formulation_plain
   end type kind_choice_type

contains

   !> A kind of element; plain where the formulation is not offered
   elemental type(element_kind_type) function element_kind(n_nodes, order, formulation) result(kind)
      !> Number of nodes, order of the rule
      integer, intent(in) :: n_nodes, order
      !> Formulation; plain if absent
      integer, intent(in), optional :: formulation

      kind = element_kind_type(n_nodes, order)
      if (.not. present(formulation)) return
      if (formulations(formulation)%offered(n_nodes)) kind%formulation = formulation
   end function element_kind

   !> The kind of elements of a number of nodes
   elemental type(element_kind_type) function chosen_kind(choice, n_nodes) result(kind)
      !> Rules and formulation
      type(kind_choice_type), intent(in) :: choice
      !> Number of nodes
      integer, intent(in) :: n_nodes

      kind = element_kind(n_nodes, merge(choice%order_linear, choice%order_quadratic, &
         n_nodes <= 4), &
                          choice%formulation)
   end function chosen_kind

   !> Place of a kind in a list; it is added if it is not there
   pure subroutine find_kind(kinds, kind, place)
      !> The list
      type(element_kind_type), allocatable, intent(inout) :: kinds(:)
      !> The kind
      type(element_kind_type), intent(in) :: kind
      !> Its place
      integer, intent(out) :: place

      do place = 1, size(kinds)
         if (same_kind(kinds(place), kind)) return
      end do
      kinds = [kinds, kind]
   end subroutine find_kind

   !> Whether two kinds are the same
   elemental logical function same_kind(a, b)
      !> The kinds
      type(element_kind_type), intent(in) :: a, b

      same_kind = a%n_nodes == b%n_nodes .and. a%order == b%order &
         .and. a%formulation == b%formulation
   end function same_kind

   !> Whether a kind is quadratic with the reduced rule
   elemental logical function is_reduced(kind)
      !> The kind
      type(element_kind_type), intent(in) :: kind

      is_reduced = kind%n_nodes > 4 .and. kind%order < full_order
   end function is_reduced

   !> Whether elements of a kind are much too stiff if they can hardly change their volume
   elemental logical function locks(kind)
      !> The kind
      type(element_kind_type), intent(in) :: kind

      locks = formulations(kind%formulation)%locks(kind%n_nodes)
   end function locks

end module axijoint_fe_element_kind
