!> Description of axijoint's own listing, in the cards that describe listings of other programs
module axijoint_compare_read_own_format
   implicit none
   private
   public :: own_format_text, own_format_name

   !> What messages call it
   character(len=*), parameter :: own_format_name = 'the built-in format'
   !> Six stresses of a solid
   character(len=*), parameter :: stresses(6) = [character(len=80) :: &
      '   COLUMN sigma_r     stress', &
      '   COLUMN sigma_z     stress', &
      '   COLUMN sigma_theta stress', &
      '   COLUMN tau_rz      stress', &
      '   COLUMN tau_rtheta  stress', &
      '   COLUMN tau_ztheta  stress']
   !> Coordinates
   character(len=*), parameter :: place(2) = [character(len=80) :: &
      '   COLUMN r coordinate', &
      '   COLUMN z coordinate']
   !> Three displacements
   character(len=*), parameter :: displacements(3) = [character(len=80) :: &
      '   COLUMN u displacement', &
      '   COLUMN v displacement', &
      '   COLUMN w displacement']
   !> Harmonic and family from a heading
   character(len=*), parameter :: mode(2) = [character(len=80) :: &
      '   COLUMN m      parameter heading', &
      '   COLUMN family parameter heading']
   !> theta from a heading
   character(len=*), parameter :: angle(1) = [character(len=80) :: &
      '   COLUMN theta angle heading']
   !> Columns of a table of points on a section, before its values
   character(len=*), parameter :: section(6) = [character(len=80) :: &
      '   COLUMN section parameter heading', &
      '   COLUMN point    label', &
      '   COLUMN r        coordinate', &
      '   COLUMN z        coordinate', &
      '   COLUMN body     key', &
      '   COLUMN material key']
   !> Cards for all tables
   character(len=*), parameter :: general(6) = [character(len=80) :: &
      'FORMAT listing of axijoint', &
      'FIRST  axijoint', &
      'LAST   END OF LISTING', &
      'IGNORE ...outside the mesh', &
      'IGNORE equilibrium error', &
      'IGNORE interface:']
   !> Status, nodes
   character(len=*), parameter :: head(11) = [character(len=80) :: &
      'TABLE status', &
      '   HEADING status {status}', &
      '   ENDS    HEADING', &
      '   COLUMN  status word heading word=***:not_converged word=linear:converged', &
      'TABLE nodes', &
      '   HEADING NODES (fixed', &
      '   SKIP    2', &
      '   COLUMN  node label       1-10', &
      '   COLUMN  r    coordinate 11-24', &
      '   COLUMN  z    coordinate 25-38', &
      '   COLUMN  fixed word      39-50']
   !> Joints
   character(len=*), parameter :: joints(15) = [character(len=80) :: &
      'TABLE joints', &
      '   HEADING JOINT STRESSES, RELATIVE DISPLACEMENTS', &
      '   SKIP    2', &
      '   COLUMN joint label', &
      '   COLUMN point label', &
      '   COLUMN r     coordinate', &
      '   COLUMN z     coordinate', &
      '   COLUMN theta angle', &
      '   COLUMN tau_xi    stress', &
      '   COLUMN sigma     stress', &
      '   COLUMN tau_theta stress', &
      '   COLUMN d_xi      jump', &
      '   COLUMN d_eta     jump', &
      '   COLUMN d_theta   jump', &
      '   COLUMN state     word']
   !> Cuts
   character(len=*), parameter :: cuts(12) = [character(len=80) :: &
      'TABLE cuts', &
      '   HEADING RESULTANTS ON CUTS', &
      '   SKIP    2', &
      '   COLUMN cut       key', &
      '   COLUMN z         coordinate', &
      '   COLUMN body      key', &
      '   COLUMN axial     force', &
      '   COLUMN shear     force', &
      '   COLUMN shear_90  force', &
      '   COLUMN moment    moment', &
      '   COLUMN moment_90 moment', &
      '   COLUMN torque    moment']
   !> Reactions of faces
   character(len=*), parameter :: faces(10) = [character(len=80) :: &
      'TABLE reactions of faces', &
      '   HEADING REACTIONS OF SUPPORTED FACES', &
      '   SKIP    2', &
      '   COLUMN face      key     1-14', &
      '   COLUMN axial     force  15-29', &
      '   COLUMN lateral   force  30-44', &
      '   COLUMN lateral_90 force 45-59', &
      '   COLUMN moment    moment 60-74', &
      '   COLUMN moment_90 moment 75-89', &
      '   COLUMN torque    moment 90-104']
   !> Equilibrium
   character(len=*), parameter :: equilibrium(7) = [character(len=80) :: &
      'TABLE equilibrium', &
      '   HEADING EQUILIBRIUM', &
      '   SKIP    2', &
      '   COLUMN resultant key    1-36', &
      '   COLUMN applied   force 37-51', &
      '   COLUMN reacted   force 52-66', &
      '   COLUMN sum       force 67-81']

contains

   !> The format as lines
   pure function own_format_text() result(text)
      !> Lines, each with its line feed
      character(len=:), allocatable :: text

      text = lines(general)//lines(head) &
         //title('displacement amplitudes', 'DISPLACEMENT AMPLITUDES, harmonic {m} {family}') &
         //lines(mode)//node()//lines(place)//lines(displacements) &
         //title('total displacements', 'TOTAL DISPLACEMENTS, theta = {theta}') &
         //lines(angle)//node()//lines(place)//lines(displacements) &
         //title('stresses at Gauss points', 'TOTAL STRESSES AT GAUSS POINTS, theta = {theta}') &
         //lines(angle)//'   COLUMN element label'//new_line('a') &
         //'   COLUMN point label'//new_line('a')//lines(place)//lines(stresses) &
         //title('stresses at nodes', 'TOTAL STRESSES AT NODES, theta = {theta}') &
         //lines(angle)//node()//'   COLUMN material key'//new_line('a') &
         //lines(place)//lines(stresses)//lines(joints) &
         //title('displacements on sections', &
                 'DISPLACEMENTS ON SECTION {section}, theta = {theta}') &
         //lines(angle)//lines(section)//lines(displacements) &
         //title('stresses on sections', 'STRESSES ON SECTION {section}, theta = {theta}') &
         //lines(angle)//lines(section)//lines(stresses)//lines(cuts) &
         //title('reactions', 'REACTIONS, harmonic {m} {family}')//lines(mode)//node()// &
         lines(place) &
         //'   COLUMN R_u force'//new_line('a')//'   COLUMN R_v force'//new_line('a') &
         //'   COLUMN R_w force'//new_line('a')//lines(faces)//lines(equilibrium)
   end function own_format_text

   !> First cards of a table
   pure function title(name, heading) result(text)
      !> Name and heading
      character(len=*), intent(in) :: name, heading
      !> Lines
      character(len=:), allocatable :: text

      text = 'TABLE '//name//new_line('a')//'   HEADING '//heading//new_line('a')// &
             '   SKIP    2'//new_line('a')
   end function title

   !> Column of node numbers
   pure function node() result(text)
      !> Line
      character(len=:), allocatable :: text

      text = '   COLUMN node label'//new_line('a')
   end function node

   !> Cards as lines
   pure function lines(cards) result(text)
      !> Cards
      character(len=*), intent(in) :: cards(:)
      !> Lines
      character(len=:), allocatable :: text

      integer :: k

      text = ''
      do k = 1, size(cards)
         text = text//trim(cards(k))//new_line('a')
      end do
   end function lines

end module axijoint_compare_read_own_format
