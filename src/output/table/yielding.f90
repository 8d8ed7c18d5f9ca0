!> Bodies that yield: what the increments took and where the criteria bear, in the listing, the
!> summary and the results file
module axijoint_output_table_yielding
   use axijoint_analysis_core_plastic_fields, only : plastic_fields_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text, lower, percent_text
   use axijoint_element_yield_law, only : criterion_names
   use axijoint_element_yield_margin, only : bearing_names
   use axijoint_model_model, only : model_type, body_method_names
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_headings, only : write_result_heading, write_sentence
   use axijoint_output_file_json, only : json_number
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_table_yield_errors, only : yield_errors_json, write_yield_errors_group
   implicit none
   private
   public :: write_yielding, yielding_json, write_yield_group

   !> Increment, iterations, elastic solutions
   character(len=*), parameter :: format_counts = '(3i10)'
   !> Number of an element, number of points
   character(len=*), parameter :: format_label = '(i10)'
   !> Columns of reals
   integer, parameter :: wide = 15
   !> Difference of stresses that is no rounding
   real(wp), parameter :: shows = 1.0e-6_wp

contains

   !> Tables of the listing
   subroutine write_yielding(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=30) :: counts
      character(len=10) :: n_yielding
      integer :: i

      if (.not. allocated(results%plastic%margin)) return
      call write_result_heading(file, "YIELDING", results%converged)
      call file%put("  (method "//trim(body_method_names(model%body_method))//"; "// &
         to_text(size(results%plastic%angles))//" planes; elastic solutions of all "// &
         "harmonics; Gauss points that planes were needed for,")
      call file%put("  % of those that can yield; points that have yielded on any plane; work dissipated "// &
         "by plastic strain)")
      call file%put(" increment iterations solutions    load factor      on planes   yielded     "// &
         "dissipated")
      do i = 1, size(results%states)
         associate (state => results%states(i), bodies => results%states(i)%bodies)
            write (counts, format_counts) state%increment, bodies%iterations, bodies%solutions
            write (n_yielding, format_label) bodies%n_yielding
            call file%put(counts//columns([state%load_factor, 100.0_wp*bodies%on_planes], wide)// &
               n_yielding//columns([bodies%dissipated], wide))
         end associate
      end do
      call write_elements(file, model, results)
      if (results%plastic%beside > shows) call write_sentence(file, "  ", 'stresses in tables are sums of the harmonics: up to '// &
         percent_text(results%plastic%beside)//' of the largest beside what the criteria admit on their planes')
   end subroutine write_yielding

   !> Elements that have yielded: the point and plane with the least margin, the largest plastic
   !> strain
   subroutine write_elements(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=10) :: label
      integer :: first, last, e, place(2)

      call write_result_heading(file, "ELEMENTS THAT HAVE YIELDED", results%converged)
      call file%put("  (largest equivalent plastic strain, sqrt(2/3 e:e); yield margin: 1 without shear, 0 at yield)")
      call file%put("   element    plastic strain          at r              z    theta [deg]   "// &
         "least margin")
      associate (fields => results%plastic, element => results%point_element)
         first = 1
         do while (first <= size(element))
            e = element(first)
            last = first
            do while (last < size(element))
               if (element(last + 1) /= e) exit
               last = last + 1
            end do
            if (any(fields%equivalent(first:last, :) > 0.0_wp)) then
               place = maxloc(fields%equivalent(first:last, :))
               write (label, format_label) model%mesh%element_label(e)
               call file%put(label//"   "//columns([ &
                  fields%equivalent(first - 1 + place(1), place(2)), &
                  results%point_position(:, first - 1 + place(1)), &
                  fields%angles(place(2))/degree, minval(fields%margin(first:last, :))], wide))
            end if
            first = last + 1
         end do
      end associate
   end subroutine write_elements

   !> In the summary: null if no body can yield
   pure function yielding_json(model, results) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON object
      character(len=:), allocatable :: json

      integer :: i

      json = "null"
      if (.not. allocated(results%plastic%margin)) return
      json = '{"method": "'//lower(trim(body_method_names(model%body_method)))// &
         '", "planes": '//json_number(size(results%plastic%angles))// &
         ', "least_margin": '//json_number(minval(results%plastic%margin))// &
         ', "largest_plastic_strain": '//json_number(maxval(results%plastic%equivalent))// &
         ', "stress_beside_criteria": '//json_number(results%plastic%beside)// &
         ', "no_equilibrium_at": '
      if (allocated(results%failing)) then
         json = json//json_number(results%tried)
      else
         json = json//"null"
      end if
      json = json//', "errors": '//yield_errors_json(results%yield_errors)//', "increments": ['
      do i = 1, size(results%states)
         if (i > 1) json = json//", "
         associate (state => results%states(i), bodies => results%states(i)%bodies)
            json = json//'{"increment": '//json_number(state%increment)// &
               ', "load_factor": '//json_number(state%load_factor)// &
               ', "iterations": '//json_number(bodies%iterations)// &
               ', "solutions": '//json_number(bodies%solutions)// &
               ', "on_planes": '//json_number(bodies%on_planes)// &
               ', "yielded": '//json_number(bodies%n_yielding)// &
               ', "dissipated": '//json_number(bodies%dissipated)//'}'
         end associate
      end do
      json = json//"]}"
   end function yielding_json

   !> In the results file: the group /yield, if bodies can yield
   subroutine write_yield_group(file, model, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      if (.not. allocated(results%plastic%margin)) return
      call file%group("/yield")
      call write_yield_errors_group(file, results%yield_errors)
      call file%attribute("/yield", "method", lower(trim(body_method_names(model%body_method))))
      call write_laws(file, model)
      call write_fields(file, results%plastic)
      associate (bodies => results%states%bodies)
         call file%write("/yield/increment", (results%states%increment), "Increment; (increment)")
         call file%write("/yield/load_factor", (results%states%load_factor), &
            "Sum of the load factors; (increment)")
         call file%write("/yield/iterations", (bodies%iterations), "Iterations; (increment)")
         call file%write("/yield/solutions", (bodies%solutions), &
            "Elastic solutions of all harmonics; (increment)")
         call file%write("/yield/on_planes", (bodies%on_planes), &
            "Share of the points that planes were needed for; (increment)")
         call file%write("/yield/n_yielded", (bodies%n_yielding), &
            "Points that have yielded on any plane; (increment)")
         call file%write("/yield/dissipated", (bodies%dissipated), &
            "Work of the stress on plastic strain so far; (increment) [force length]")
      end associate
      if (.not. allocated(results%failing)) return
      call file%attribute("/yield", "no_equilibrium_at", results%tried)
      call file%write("/yield/failing_displacement", results%failing, &
         "Amplitudes u, v, w from the last equilibrium on in the step that found none; "// &
         "(3, node, mode) [length]")
   end subroutine write_yield_group

   !> The laws
   subroutine write_laws(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=:), allocatable :: names
      real(wp), allocatable :: tension(:)
      integer :: i

      names = ""
      do i = lbound(criterion_names, 1), ubound(criterion_names, 1)
         names = names//to_text(i)//" "//trim(criterion_names(i))//", "
      end do
      associate (laws => model%materials%yield)
         tension = laws%tension
         where (.not. tension < huge(1.0_wp)) tension = -1.0_wp
         call file%write("/yield/criterion", (laws%criterion), names//"(material)")
         call file%write("/yield/strength", (laws%strength), &
            "Uniaxial yield stress, or cohesion; (material) [stress]")
         call file%write("/yield/friction", (laws%friction), "phi; (material) [radian]")
         call file%write("/yield/dilation", (laws%dilation), "psi; (material) [radian]")
         call file%write("/yield/hardening", (laws%hardening), "H'; (material) [stress]")
         call file%write("/yield/tension", tension, &
            "Borne at most, -1 if the criterion alone says; (material) [stress]")
         call file%write("/yield/gradient", (laws%gradient), &
            "Growth of the strength with depth; (material) [stress/length]")
         call file%write("/yield/level", (laws%level), "z from which on; (material) [length]")
      end associate
   end subroutine write_laws

   !> The fields
   subroutine write_fields(file, fields)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The fields
      type(plastic_fields_type), intent(in) :: fields

      character(len=:), allocatable :: names
      integer :: i

      call file%write("/yield/planes", fields%angles, "theta; (plane) [radian]")
      call file%write("/yield/plastic_strain", fields%amplitude, "Amplitudes r, z, theta, rz, "// &
         "r-theta, z-theta, shear as in engineering; (6, point, mode)")
      call file%write("/yield/equivalent", fields%equivalent, &
         "Equivalent plastic strain sqrt(2/3 e:e); (point, plane)")
      call file%write("/yield/margin", fields%margin, &
         "Share of the strength that is left, 1 without shear, 0 at yield; (point, plane)")
      call file%write("/yield/stress", fields%stress, "Stress that the criteria admit on the planes at the points "// &
         "that can yield, r, z, theta, rz, r-theta, z-theta; (6, own point, plane) [stress]")
      call file%write("/yield/stress_point", fields%place, "Gauss point (index) of each; (own point)")
      call file%write("/yield/dissipation", fields%dissipation, "Work that plastic strain dissipated per volume in the "// &
         "last increment that had a step in equilibrium; (point, plane) [stress]")
      call file%write("/yield/point_weight", fields%weight, "Weight of the point in an integral over r, z, "// &
         "r included, 0 where nothing can yield; (point) [length^3]")
      call file%write("/yield/plane_weight", fields%plane_weight, "Weight of the plane in an integral round the "// &
         "circle; (plane) [radian]")
      names = ""
      do i = lbound(bearing_names, 1), ubound(bearing_names, 1)
         names = names//to_text(i)//" "//trim(bearing_names(i))//", "
      end do
      call file%write("/yield/active", fields%bearing, "What of the criterion bears: "// &
         names//"(point, plane)")
   end subroutine write_fields

end module axijoint_output_table_yielding
