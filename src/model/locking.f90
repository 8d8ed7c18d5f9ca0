!> Elements that lock: much too stiff where a material can hardly change its volume
module axijoint_model_locking
   use axijoint_base_kinds, only : wp
   use axijoint_fe_element_kind, only : element_kind_type, is_reduced, locks
   use axijoint_model_material, only : solid_material_type, elasticity
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: elements_lock, is_nearly_incompressible, has_nearly_incompressible, effective_ratio

   !> Poisson's ratio above which linear elements lock visibly
   real(wp), parameter :: largest_ratio = 0.49_wp + 1.0e-9_wp

contains

   !> Whether elements lock somewhere, or finer ones tell little of them
   pure logical function elements_lock(model)
      !> The job
      type(model_type), intent(in) :: model

      logical :: nearly(size(model%materials))
      integer :: k, element

      nearly = [(is_nearly_incompressible(model%materials(k)), k=1, size(nearly))]
      elements_lock = .false.
      if (.not. any(nearly)) return
      associate (mesh => model%mesh)
         do element = 1, size(mesh%element_kind)
            if (.not. nearly(mesh%element_material(element))) cycle
            elements_lock = elements_lock .or. locks(mesh%kinds(mesh%element_kind(element))) &
               .or. is_near_to_it(mesh%kinds(mesh%element_kind(element)))
         end do
      end associate
   end function elements_lock

   !> Whether elements are near to locking beside corners, and finer ones as well: of 8- and 9-node elements by all points, and of
   !> 8-node elements by fewer, estimates were 2 to 30 times too small there
   elemental logical function is_near_to_it(kind) result(is)
      !> The kind
      type(element_kind_type), intent(in) :: kind

      is = kind%n_nodes == 8 .or. (kind%n_nodes == 9 .and. .not. is_reduced(kind))
   end function is_near_to_it

   !> Whether a material can hardly change its volume
   pure logical function is_nearly_incompressible(material)
      !> The material
      type(solid_material_type), intent(in) :: material

      is_nearly_incompressible = effective_ratio(material) > largest_ratio
   end function is_nearly_incompressible

   !> Whether an element is of a material that can hardly change its volume
   pure logical function has_nearly_incompressible(model) result(has)
      !> The job
      type(model_type), intent(in) :: model

      integer :: k

      has = .false.
      do k = 1, size(model%materials)
         if (is_nearly_incompressible(model%materials(k))) has = has .or. any(model%mesh%element_material == k)
      end do
   end function has_nearly_incompressible

   !> Poisson's ratio of an isotropic solid of the same resistance to a change of
   !> volume and, on the average, to shear
   pure real(wp) function effective_ratio(material) result(ratio)
      !> The material
      type(solid_material_type), intent(in) :: material

      real(wp) :: d(6, 6), bulk, shear

      ratio = material%poisson
      if (.not. material%orthotropic) return
      d = elasticity(material)
      bulk = sum(d(1:3, 1:3))/9.0_wp
      shear = (d(4, 4) + d(5, 5) + d(6, 6))/3.0_wp
      ratio = (3.0_wp*bulk - 2.0_wp*shear)/(6.0_wp*bulk + 2.0_wp*shear)
   end function effective_ratio

end module axijoint_model_locking
