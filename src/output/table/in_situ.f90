!> How far in-situ stress is out of balance: in the listing, the summary and the HDF5 file
module axijoint_output_table_in_situ
   use axijoint_analysis_core_in_situ, only : in_situ_type, in_situ_part_type, in_situ_boundary_type
   use axijoint_base_kinds, only : wp
   use axijoint_model_model, only : model_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_headings, only : write_heading
   use axijoint_output_file_json, only : json_number, json_integers
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_in_situ, in_situ_json, write_in_situ_group

   !> Columns of a real
   integer, parameter :: wide = 15
   !> Node and body of a part; node, direction and increment of a traction; body and materials
   character(len=*), parameter :: format_part = '(2i10)', format_place = '(i10, 3x, a1, i6)', &
      format_pair = '(i10, i12, i10)'
   !> Directions of a traction
   character(len=1), parameter :: direction_name(2) = ["r", "z"]

contains

   !> Whether there is in-situ stress
   pure logical function has_findings(findings)
      !> What was found
      type(in_situ_type), intent(in) :: findings

      has_findings = .false.
      if (allocated(findings%parts)) has_findings = size(findings%parts) > 0
   end function has_findings

   !> Table of the parts, and of boundaries of materials
   subroutine write_in_situ(file, model, findings)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> What was found
      type(in_situ_type), intent(in) :: findings

      character(len=32) :: words
      integer :: k

      if (.not. has_findings(findings)) return
      call write_heading(file, "IN-SITU STRESS BEFORE ANYTHING MOVES (shares out of balance)")
      call file%put("   part of      body        largest         weight       traction        "// &
         "over the       over the"// &
                    "        at  along  incr.")
      call file%put("      node                   stress      and gamma      left over        "// &
         "largest   stress there"// &
                    "      node")
      do k = 1, size(findings%parts)
         associate (part => findings%parts(k))
            if (part%has_stress) call put_part(part)
         end associate
      end do
      do k = 1, size(findings%parts)
         associate (part => findings%parts(k))
            if (part%has_stress) cycle
            write (words, format_part) model%mesh%node_label(part%node), part%body
            call file%put(trim(words)//"   has none; joints press it with up to"// &
               columns([part%pressed], wide))
         end associate
      end do
      if (size(findings%boundaries) == 0) return
      call file%put("")
      call file%put("  boundaries of materials: traction and its jump")
      call file%put("      body   materials                traction           jump          "// &
         "share              r              z")
      do k = 1, size(findings%boundaries)
         associate (boundary => findings%boundaries(k))
            write (words, format_pair) boundary%bodies(1), model%materials(boundary%materials)%label
            call file%put(words(:32)//columns([boundary%traction, boundary%jump, boundary%share(), &
               boundary%position], wide))
         end associate
      end do

   contains

      !> The line of a part
      subroutine put_part(part)
         !> The part
         type(in_situ_part_type), intent(in) :: part

         character(len=20) :: place

         write (words, format_part) model%mesh%node_label(part%node), part%body
         place = ""
         if (part%on_place%node > 0) &
            write (place, format_place) model%mesh%node_label(part%on_place%node), &
            direction_name(part%on_place%direction), part%on_place%increment
         call file%put(words(:20)//columns([part%largest, part%weight_share, &
            part%on_place%traction, &
                                            part%on_whole%share, part%on_place%share], wide)//place)
      end subroutine put_part

   end subroutine write_in_situ

   !> The same as a JSON object; null without in-situ stress
   function in_situ_json(model, findings) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> What was found
      type(in_situ_type), intent(in) :: findings
      !> The object
      character(len=:), allocatable :: json

      integer :: k

      json = "null"
      if (.not. has_findings(findings)) return
      json = '{"parts": ['
      do k = 1, size(findings%parts)
         associate (part => findings%parts(k))
            if (k > 1) json = json//", "
            json = json//'{"node": '//json_number(model%mesh%node_label(part%node))// &
               ', "body": '// &
               json_number(part%body)//', "meant": '//trim(merge("true ", "false", part%meant))
            if (part%has_stress) then
               json = json//', "largest": '//json_number(part%largest)//', "weight": '// &
                  json_number(part%weight_share)// &
                  ', "traction": '//json_number(part%on_place%traction)//', "over_largest": '// &
                  json_number(part%on_whole%share)//', "over_local": '// &
                  json_number(part%on_place%share)//'}'
            else
               json = json//', "pressed": '//json_number(part%pressed)//'}'
            end if
         end associate
      end do
      json = json//'], "boundaries": ['
      do k = 1, size(findings%boundaries)
         associate (boundary => findings%boundaries(k))
            if (k > 1) json = json//", "
            json = json//'{"body": '//json_number(boundary%bodies(1))//', "materials": '// &
               json_integers((model%materials(boundary%materials)%label))//', "jump": '// &
               json_number(boundary%jump)// &
               ', "share": '//json_number(boundary%share())//'}'
         end associate
      end do
      json = json//']}'
   end function in_situ_json

   !> The same in the HDF5 file; no group without in-situ stress
   subroutine write_in_situ_group(file, findings)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> What was found
      type(in_situ_type), intent(in) :: findings

      integer :: k

      if (.not. has_findings(findings)) return
      associate (parts => findings%parts, boundaries => findings%boundaries)
         call file%group("/in_situ")
         call file%write("/in_situ/node", (parts%node), "A node of the part (index); (part)")
         call file%write("/in_situ/body", (parts%body), "Body; (part)")
         call file%write("/in_situ/meant", merge(1, 0, parts%meant), &
            "1 if it is meant to be out of balance; (part)")
         call file%write("/in_situ/largest", (parts%largest), &
            "Largest in-situ stress, 0 if it has none; (part) [stress]")
         call file%write("/in_situ/weight", (parts%weight_share), &
            "Difference of gamma and weight over the larger; (part)")
         call file%write("/in_situ/traction", (parts%on_place%traction), &
            "Traction that no support, joint or load takes; (part) [stress]")
         call file%write("/in_situ/over_largest", (parts%on_whole%share), &
            "Largest of these over the largest stress along its direction; (part)")
         call file%write("/in_situ/over_local", (parts%on_place%share), &
            "Largest over the stress at its place; (part)")
         call file%write("/in_situ/pressed", (parts%pressed), &
            "Largest stress of joints on a part that has no in-situ stress; (part) [stress]")
         call file%write("/in_situ/boundary_materials", &
            reshape([(boundaries(k)%materials, k=1, size(boundaries))], &
            [2, size(boundaries)]), "Indices into /materials; (2, boundary)")
         call file%write("/in_situ/boundary_jump", (boundaries%jump), &
            "Largest jump of traction; (boundary) [stress]")
         call file%write("/in_situ/boundary_share", boundaries%share(), &
            "Jump over the largest traction; (boundary)")
      end associate
   end subroutine write_in_situ_group

end module axijoint_output_table_in_situ
