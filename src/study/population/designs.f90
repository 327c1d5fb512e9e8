!> Designs of one wall, such as ties, on the same records: the median of each over that of the first.
!>
!> A record that is hard on the wall is hard on all its designs. To first order a cluster of records changes ln theta of a design
!> by d_g (dondolo_fragility_clustered); it changes the difference to the first by d_g - d_g1, so that the variance of that
!> difference is sum_g (d_g - d_g1)^2, much less than that of either median. Intervals use Student's t with one degree of freedom
!> less than there are clusters.
module dondolo_population_designs
   use dondolo_base_kinds, only : wp
   use dondolo_check_safety, only : safety_type
   use dondolo_fragility, only : fragility_type
   use dondolo_fragility_clustered, only : confidence
   use dondolo_fragility_ratio, only : compare_parameters
   use dondolo_wall, only : wall_type
   use dondolo_wall_chain_model, only : chain_model_type
   use dondolo_wall_one_block_model, only : one_block_model_type
   use dondolo_wall_tie_statics, only : plastic_acceleration
   implicit none
   private

   public :: design_type, compare_designs

   !> Density of steel [kg/m3]
   real(wp), parameter :: steel_density = 7850.0_wp

   !> A design
   type :: design_type
      !> Its name
      character(len=:), allocatable :: name
      !> Its curve of collapse
      type(fragility_type) :: curve
      !> Change of ln theta without each cluster of records; 0 without standard errors
      real(wp), allocatable :: change(:)
      !> Mass of its ties [kg per m of wall], of a chain in all [kg]
      real(wp) :: steel = 0.0_wp
      !> Acceleration that it withstands statically with its ties at yield / gravity
      real(wp) :: alpha_0 = 0.0_wp
      !> Its check by a building code
      type(safety_type) :: safety
      !> Are the following known? The curves of this design and of the first have clustered standard errors
      logical :: is_compared = .false.
      !> Median / that of the first, its interval, and probability of a ratio as far from 1 if the medians were equal
      real(wp) :: ratio = 0.0_wp, low = 0.0_wp, high = 0.0_wp, p_value = 1.0_wp
   contains
      !> Take the numbers that follow from the wall alone
      procedure :: take_wall
      !> Relative increase of the median for each kg/m of steel more than in another design
      procedure :: gain_per_kg
   end type design_type

contains

   !> Take the numbers that follow from the wall alone
   subroutine take_wall(self, wall)
      class(design_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall

      self%name = wall%name()
      self%alpha_0 = plastic_acceleration(wall%mechanism)/wall%gravity
      select type (model => wall%model)
      type is (one_block_model_type)
         if (allocated(model%body%anchors)) self%steel = steel_density*sum(model%body%anchors%area*model%body%anchors%length)
      type is (chain_model_type)
         self%steel = steel_density*sum(model%anchors%area*model%anchors%length)
      end select
   end subroutine take_wall

   !> Relative increase of the median for each kg/m of steel more than in another design; 0: there is none [m/kg]
   pure real(wp) function gain_per_kg(self, first) result(gain)
      class(design_type), intent(in) :: self
      !> The design that it was compared with
      type(design_type), intent(in) :: first

      gain = 0.0_wp
      if (self%is_compared .and. self%steel > first%steel) gain = (self%ratio - 1.0_wp)/(self%steel - first%steel)
   end function gain_per_kg

   !> Compare all designs with the first
   pure subroutine compare_designs(designs)
      !> Designs with their curves and their changes
      type(design_type), intent(inout) :: designs(:)

      real(wp) :: interval(2)
      integer :: i

      associate (first => designs(1))
         do i = 1, size(designs)
            associate (design => designs(i))
               design%is_compared = design%curve%errors == 'clustered' .and. first%curve%errors == 'clustered' &
                  & .and. design%curve%has_fit() .and. first%curve%has_fit()
               if (.not. design%is_compared) cycle
               design%ratio = design%curve%theta/first%curve%theta
               call compare_parameters(design%ratio, design%change - first%change, min(design%curve%degrees_of_freedom, &
                  & first%curve%degrees_of_freedom), confidence, interval, design%p_value)
               design%low = interval(1)
               design%high = interval(2)
            end associate
         end do
      end associate
   end subroutine compare_designs

end module dondolo_population_designs
