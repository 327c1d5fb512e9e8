!> The synthetic suite of the project: 22 scenarios with two horizontal components each.
!>
!> Magnitudes follow Italian earthquakes from 1972 to 2016 (rounded); the names of the scenarios only say which.
!> Distances and sites are not those of any record: they spread the peak acceleration from about 0.03 to 0.6 g.
module dondolo_record_synthetic_suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_record, only : record_type
   use dondolo_record_synthetic, only : synthetic_record
   implicit none
   private

   public :: scenario_type, synthetic44, suite_record

   !> Seed of the suite
   integer, parameter :: suite_seed = 19722016

   !> Letters of the two horizontal components
   character(len=*), parameter :: letters = 'ab'

   !> One scenario
   type :: scenario_type
      !> Name: the earthquake after which the magnitude is chosen
      character(len=20) :: name
      !> Magnitude
      real(wp) :: magnitude
      !> Epicentral distance [km]
      real(wp) :: distance
      !> Site
      character(len=7) :: site
   end type scenario_type

   !> The scenarios
   type(scenario_type), parameter :: synthetic44(22) = [ &
      & scenario_type('ancona_1972', 4.8_wp, 6.0_wp, 'rock'), &
      & scenario_type('friuli_1976_may_06', 6.4_wp, 25.0_wp, 'shallow'), &
      & scenario_type('friuli_1976_sep_11', 5.6_wp, 15.0_wp, 'deep'), &
      & scenario_type('friuli_1976_sep_15', 6.0_wp, 8.0_wp, 'shallow'), &
      & scenario_type('patti_1978', 6.0_wp, 30.0_wp, 'rock'), &
      & scenario_type('valnerina_1979', 5.8_wp, 12.0_wp, 'rock'), &
      & scenario_type('irpinia_1980', 6.9_wp, 20.0_wp, 'rock'), &
      & scenario_type('gubbio_1984', 5.6_wp, 20.0_wp, 'shallow'), &
      & scenario_type('lazio_abruzzo_1984', 5.9_wp, 40.0_wp, 'deep'), &
      & scenario_type('potenza_1990', 5.8_wp, 28.0_wp, 'rock'), &
      & scenario_type('eastern_sicily_1990', 5.6_wp, 35.0_wp, 'deep'), &
      & scenario_type('correggio_1996', 5.4_wp, 16.0_wp, 'deep'), &
      & scenario_type('colfiorito_1997', 6.0_wp, 5.0_wp, 'rock'), &
      & scenario_type('umbria_1997', 5.6_wp, 10.0_wp, 'shallow'), &
      & scenario_type('lauria_1998', 5.6_wp, 25.0_wp, 'rock'), &
      & scenario_type('molise_2002', 5.7_wp, 45.0_wp, 'rock'), &
      & scenario_type('l_aquila_2009_apr_06', 6.3_wp, 4.0_wp, 'shallow'), &
      & scenario_type('l_aquila_2009_apr_07', 5.5_wp, 14.0_wp, 'rock'), &
      & scenario_type('emilia_2012_may_20', 6.1_wp, 16.0_wp, 'deep'), &
      & scenario_type('emilia_2012_may_29', 6.0_wp, 6.0_wp, 'deep'), &
      & scenario_type('amatrice_2016', 6.0_wp, 9.0_wp, 'rock'), &
      & scenario_type('norcia_2016', 6.5_wp, 8.0_wp, 'shallow')]

contains

   !> Make one record of the suite
   subroutine suite_record(scenario, component, record, error)
      !> Number of the scenario, 1 to 22
      integer, intent(in) :: scenario
      !> Component, 1 or 2
      integer, intent(in) :: component
      type(record_type), intent(out) :: record
      !> It could not be made
      type(error_type), allocatable, intent(out) :: error

      type(scenario_type) :: chosen
      character(len=2) :: number
      character(len=3) :: magnitude

      chosen = synthetic44(scenario)
      call synthetic_record(record, chosen%magnitude, chosen%distance, trim(chosen%site), suite_seed, &
         & 2*(scenario - 1) + component - 1, 0.0_wp, error)
      if (allocated(error)) return
      write (number, '(i2.2)') scenario
      write (magnitude, '(f3.1)') chosen%magnitude
      record%name = number//'_'//trim(chosen%name)//'_m'//magnitude//'_'//letters(component:component)
   end subroutine suite_record

end module dondolo_record_synthetic_suite
