!> What the listing says about approximations: what was left out without any error, and
!> the error that each of the others leaves
module axijoint_output_listing_budget
   use axijoint_analysis_core_results, only : results_type, error_share_type, source_names, source_solver
   use axijoint_analysis_error_budget, only : sum_of_shares, is_known
   use axijoint_analysis_error_cut_errors, only : n_kinds, sizes_on_cuts
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, count_of, fine_percent
   use axijoint_model_mesh, only : n_joints
   use axijoint_model_model, only : model_type
   use axijoint_output_file_columns, only : columns, known_column
   use axijoint_output_file_headings, only : write_heading, write_result_heading, write_sentence
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_left_out, write_budget, write_singular, laws_at, singular_text, write_rounds, &
      sum_text, remedy_text

   !> Columns of a value
   integer, parameter :: wide = 15, narrow = 12

contains

   !> What was not modelled
   subroutine write_left_out(file, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      integer :: i

      if (.not. allocated(results%left_out)) return
      if (size(results%left_out) == 0) return
      call write_heading(file, "LEFT OUT (exact: zero, or like something else)")
      do i = 1, size(results%left_out)
         call file%put("  "//results%left_out(i)%text)
      end do
   end subroutine write_left_out

   !> Approximations side by side, and the largest
   subroutine write_budget(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      logical :: points, cuts, sections
      integer :: i

      if (.not. allocated(results%budget)) return
      call write_result_heading(file, "ERROR BUDGET (estimates; relative, - not known)", &
         results%converged)
      points = size(model%points) > 0
      cuts = size(model%cuts) > 0
      sections = size(model%lines) > 0
      call file%put("  left by           energy norm   displacement   joint stress"// &
         repeat("      at POINTS", merge(1, 0, points))//repeat("        on CUTS", merge(1, 0, cuts))// &
         repeat("    on SECTIONS", merge(1, 0, sections))//"           load")
      do i = 1, size(results%budget)
         call file%put(share_line(results%budget(i), points, cuts, sections))
      end do
      call file%put(share_line(sum_of_shares(results%budget), points, cuts, sections))
      call write_sentence(file, "  ", sum_text(results))
      if (len(remedy_text(results%budget)) > 0) &
         call file%put("  about half with "//remedy_text(results%budget))
      if (points) call write_points(file, model, results)
      if (cuts) call write_cut_errors(file, model, results)
      if (sections) call write_line_errors(file, model, results)
   end subroutine write_budget

   !> Errors of the resultants on cuts, and the largest of each kind by what leaves them
   subroutine write_cut_errors(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results with a budget
      type(results_type), intent(in) :: results

      character(len=20) :: place
      type(error_share_type) :: total
      integer :: c, i

      total = sum_of_shares(results%budget)
      call write_result_heading(file, "ERRORS ON CUTS (estimates; shear and moment whatever their angle; - not known)", &
         results%converged)
      call file%put("     cut           z    axial force          shear         moment         torque")
      do c = 1, size(model%cuts)
         write (place, "(i8, es12.4)") model%cuts(c)%label, model%cuts(c)%z
         call file%put(place//kinds(total%on_cuts(:, c)))
      end do
      call file%put("  the largest, left by")
      do i = 1, size(results%budget)
         call file%put("  "//source_names(results%budget(i)%source)//"    "//kinds(maxval(results%budget(i)%on_cuts, 2)))
      end do
      call file%put("  of the largest"//"    "//kinds(maxval(sizes_on_cuts(results%cut_resultants), 2)))

   contains

      !> A value of each kind
      pure function kinds(values) result(text)
         !> The values
         real(wp), intent(in) :: values(n_kinds)
         !> Columns
         character(len=:), allocatable :: text

         integer :: k

         text = ""
         do k = 1, n_kinds
            text = text//known_column(values(k), wide)
         end do
      end function kinds

   end subroutine write_cut_errors

   !> Errors of the displacements of points with names
   subroutine write_points(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results with a budget
      type(results_type), intent(in) :: results

      character(len=28) :: names(size(model%points))
      type(error_share_type) :: total
      integer :: i, p

      do p = 1, size(names)
         write (names(p), "(i10, 2x, a)") model%points(p)%label, model%points(p)%name
      end do
      total = sum_of_shares(results%budget)
      call write_result_heading(file, "ERRORS AT POINTS (estimates of the largest round the circle; - not known)", &
         results%converged)
      call write_places(file, results, "     point  name              displacement", names, results%point_size, total%at_points, &
         reshape([(results%budget(i)%at_points, i=1, size(results%budget))], [size(names), size(results%budget)]))
   end subroutine write_points

   !> Errors of the stresses along lines
   subroutine write_line_errors(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results with a budget
      type(results_type), intent(in) :: results

      character(len=28) :: names(size(model%lines))
      type(error_share_type) :: total
      integer :: i, k

      do k = 1, size(names)
         associate (points => results%discretization%line_points(:, k))
            write (names(k), "(i10, a18)") model%lines(k)%label, to_text(points(1))//" of "//to_text(points(2))
         end associate
      end do
      total = sum_of_shares(results%budget)
      call write_result_heading(file, "ERRORS ON SECTIONS (estimates, of the largest stress round the circle; - not known)", &
         results%converged)
      call write_places(file, results, "   section     points judged        stress", names, results%discretization%line_stress, &
         total%on_lines, reshape([(results%budget(i)%on_lines, i=1, size(results%budget))], [size(names), size(results%budget)]))
   end subroutine write_line_errors

   !> Errors place by place, by what leaves them
   subroutine write_places(file, results, head, names, sizes, total, errors)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results with a budget
      type(results_type), intent(in) :: results
      !> Names of the first columns
      character(len=*), intent(in) :: head
      !> What stands in front of each row
      character(len=*), intent(in) :: names(:)
      !> What errors are parts of, the errors, and what sources leave of them, shape (places) and (places, sources); negative if not
      !> known
      real(wp), intent(in) :: sizes(:), total(:), errors(:, :)

      character(len=len(source_names)) :: name
      character(len=:), allocatable :: line
      real(wp) :: relative
      integer :: i, p

      line = head//"       error    relative"
      do i = 1, size(errors, 2)
         name = source_names(results%budget(i)%source)
         line = line//repeat(" ", column(i) - len_trim(name))//trim(name)
      end do
      call file%put(line)
      do p = 1, size(names)
         relative = -1.0_wp  ! where there is nothing it means nothing
         if (sizes(p) > total(p)) relative = max(-1.0_wp, total(p)/sizes(p))
         line = names(p)//known_column(sizes(p), wide - 1)//known_column(total(p), narrow)//known_column(relative, narrow)
         do i = 1, size(errors, 2)
            line = line//known_column(errors(p, i), column(i))
         end do
         call file%put(line)
      end do

   contains

      !> Columns of a source: the name of the first is longest
      pure integer function column(i)
         !> Its place
         integer, intent(in) :: i

         column = merge(wide, narrow, i == 1)
      end function column

   end subroutine write_places

   !> A share as a line of the table
   pure function share_line(share, points, cuts, sections) result(line)
      !> The share
      type(error_share_type), intent(in) :: share
      !> Whether there are points with names, cuts, and lines
      logical, intent(in) :: points, cuts, sections
      !> The line
      character(len=:), allocatable :: line

      line = "  "//source_names(share%source)//known_column(share%energy, wide)// &
         known_column(share%displacement, wide)// &
             known_column(share%joint_stress, wide)
      if (points) line = line//known_column(share%points, wide)
      if (cuts) line = line//known_column(share%cuts, wide)
      if (sections) line = line//known_column(share%sections, wide)
      line = line//known_column(share%load, wide)
   end function share_line

   !> Rounds of refinement; no times, which differ from run to run
   subroutine write_rounds(file, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      character(len=*), parameter :: format_round = "(i10, f13.2, i8, i12, i10, i14)"
      character(len=67) :: line
      integer :: i

      if (.not. allocated(results%rounds)) return
      call write_heading(file, "ROUNDS OF REFINEMENT")
      call file%put("     round   elements x   nodes           M    planes      "// &
         "unknowns          error")
      do i = 1, size(results%rounds)
         associate (round => results%rounds(i))
            write (line, format_round) i, round%mesh, round%nodes, round%harmonic, round%planes, &
               round%n_unknowns
            call file%put(line//known_column(round%error, wide))
         end associate
      end do
   end subroutine write_rounds

   !> Where stresses are infinite
   subroutine write_singular(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=*), parameter :: format_place = "(i10, 2es15.5, f13.3)"
      character(len=53) :: line
      character(len=20) :: distance
      integer :: i

      if (.not. has_singular(results)) return
      call write_heading(file, "INFINITE STRESSES (they go like a power of the distance)")
      call file%put("      node              r              z        power   not judged within"// &
         "   joints of laws")
      do i = 1, size(results%singular)
         associate (place => results%singular(i))
            write (line, format_place) model%mesh%node_label(place%node), &
               model%mesh%coordinates(:, place%node), place%exponent
            distance = "-"
            if (place%distance > 0.0_wp) distance = to_text(place%distance)
            distance = adjustr(distance)
            call file%put(line//distance//"   "//laws_text(laws_at(model, place%node)))
         end associate
      end do
   end subroutine write_singular

   !> Numbers of the laws of the joints at a node, ascending
   pure function laws_at(model, node) result(laws)
      !> The job
      type(model_type), intent(in) :: model
      !> The node
      integer, intent(in) :: node
      !> The numbers
      integer, allocatable :: laws(:)

      logical :: there(size(model%joint_materials))
      integer :: k

      there = .false.
      associate (mesh => model%mesh)
         do k = 1, n_joints(mesh)
            if (any(mesh%joint_nodes(:4, k) == node)) there(mesh%joint_material(k)) = .true.
         end do
      end associate
      laws = [integer ::]
      do k = 1, size(there)
         if (there(k)) laws = [laws, model%joint_materials(k)%label]
      end do
   end function laws_at

   !> Numbers of laws in words
   pure function laws_text(laws) result(text)
      !> The numbers
      integer, intent(in) :: laws(:)
      !> Such as "1, 2"; a dash if there are none
      character(len=:), allocatable :: text

      integer :: k

      text = "-"
      do k = 1, size(laws)
         if (k == 1) text = to_text(laws(k))
         if (k > 1) text = text//", "//to_text(laws(k))
      end do
   end function laws_text

   !> Whether stresses are infinite somewhere
   pure logical function has_singular(results) result(has)
      !> Results
      type(results_type), intent(in) :: results

      has = .false.
      if (allocated(results%singular)) has = size(results%singular) > 0
   end function has_singular

   !> How many places have infinite stresses, and where they grow fastest; empty if none has
   pure function singular_text(model, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A sentence
      character(len=:), allocatable :: text

      character(len=6) :: power

      text = ""
      if (.not. has_singular(results)) return
      associate (place => results%singular(minloc(results%singular%exponent, 1)))
         write (power, "(f6.2)") place%exponent
         text = "at "//count_of(size(results%singular), "node")//"; like distance^"// &
            trim(adjustl(power))// &
                " at node "//to_text(model%mesh%node_label(place%node))//" (r = "// &
                to_text(model%mesh%coordinates(1, place%node))//", z = "// &
                to_text(model%mesh%coordinates(2, place%node))//")"
      end associate
   end function singular_text

   !> Displacement and joint stress in all, each with what leaves most of it
   pure function sum_text(results) result(text)
      !> Results with a budget
      type(results_type), intent(in) :: results
      !> A sentence
      character(len=:), allocatable :: text

      type(error_share_type) :: total
      logical :: at_least, in_any_case

      total = sum_of_shares(results%budget)
      text = "nothing that is known leaves an error"
      if (max(total%displacement, total%joint_stress) <= 0.0_wp) return
      associate (budget => results%budget)
         ! what joints would answer moves the bodies, too
         in_any_case = results%hides_errors()
         at_least = in_any_case .or. &
            (total%joint_stress >= 0.0_wp .and. .not. is_known(budget, (budget%joint_stress)))
         text = "displacement "//quantity_text(budget, (budget%displacement), total%displacement, at_least)
         if (total%points >= 0.0_wp) &
            text = text//"; at POINTS "//quantity_text(budget, (budget%points), total%points, at_least)
         if (total%cuts >= 0.0_wp) then
            text = text//"; resultants on CUTS "//quantity_text(budget, (budget%cuts), total%cuts, at_least)
            associate (known => count(total%on_cuts(1, :) >= 0.0_wp), all => size(total%on_cuts, 2))
               if (known < all .and. known > 0) text = text//" ("//to_text(known)//" of "//to_text(all)//" cuts)"
            end associate
         end if
         if (total%sections >= 0.0_wp) then
            text = text//"; stress on SECTIONS "//quantity_text(budget, (budget%sections), total%sections, &
               at_least .or. results%stress_in_part)
            associate (points => sum(results%discretization%line_points, 2))
               if (points(1) < points(2)) text = text//" ("//to_text(points(1))//" of "//to_text(points(2))// &
                  " points, away from infinite ones)"
            end associate
         end if
         if (total%joint_stress < 0.0_wp) return
         text = text//"; joint stress "//quantity_text(budget, (budget%joint_stress), &
            total%joint_stress, in_any_case .or. results%torn)
      end associate
      if (.not. has_singular(results)) return
      if (any(results%singular%distance > 0.0_wp)) text = text//", away from infinite ones ("// &
         to_text(count(results%judged))//" of "//to_text(size(results%judged))//" joint points)"
   end function sum_text

   !> A quantity in all, and its largest source
   pure function quantity_text(budget, shares, total, at_least) result(text)
      !> The budget
      type(error_share_type), intent(in) :: budget(:)
      !> Its shares of the quantity, and their sum
      real(wp), intent(in) :: shares(:), total
      !> Whether something of it is not known in any case
      logical, intent(in) :: at_least
      !> Such as 4.62 %, most by discretization (2.31 %), or at least 0.12 %, of what is known most by planes (0.1 %), not
      !> known: discretization
      character(len=:), allocatable :: text

      integer :: i

      text = "not known"
      if (.not. is_judged(budget, shares)) return
      text = fine_percent(total)
      if (at_least .or. .not. is_known(budget, shares)) text = "at least "//text
      if (total > 0.0_wp) then
         associate (most => maxloc(shares, 1))
            text = text//","
            if (.not. is_known(budget, shares)) text = text//" of what is known"
            text = text//" most by "//trim(source_names(budget(most)%source))//" ("//fine_percent(shares(most))//")"
         end associate
      end if
      if (is_known(budget, shares)) return
      text = text//", not known:"
      do i = 1, size(budget)
         if (shares(i) < 0.0_wp .and. budget(i)%source /= source_solver) text = text//" "//trim(source_names(budget(i)%source))//","
      end do
      text = text(:len(text) - 1)
   end function quantity_text

   !> Whether all is known, or anything more than rounding
   pure logical function is_judged(budget, shares)
      !> The budget
      type(error_share_type), intent(in) :: budget(:)
      !> Its shares of a quantity
      real(wp), intent(in) :: shares(:)

      is_judged = is_known(budget, shares) .or. any(shares > 0.0_wp .and. budget%source /= source_solver)
   end function is_judged

   !> What would halve the largest shares of displacement and of joint stress; empty if there are
   !> none, or others are not known
   pure function remedy_text(budget) result(text)
      !> The budget
      type(error_share_type), intent(in) :: budget(:)
      !> The words
      character(len=:), allocatable :: text

      !> What is rounding
      real(wp), parameter :: nothing = 1.0e-9_wp
      integer :: place(2)

      text = ""
      place = [maxloc(budget%displacement, 1), maxloc(budget%joint_stress, 1)]
      if (budget(place(1))%displacement > nothing .and. is_known(budget, (budget%displacement))) text = budget(place(1))%remedy
      if (.not. (budget(place(2))%joint_stress > nothing .and. is_known(budget, (budget%joint_stress)))) return
      if (budget(place(2))%remedy == text) return
      if (len(text) > 0) text = text//"; "
      text = text//budget(place(2))%remedy
   end function remedy_text

end module axijoint_output_listing_budget
