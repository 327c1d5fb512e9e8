!> Intensity measures of an accelerogram, and the units their levels are given in.
module dondolo_intensity
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_record, only : record_type
   use dondolo_text, only : join
   implicit none
   private

   public :: im_names, check_im, intensity, level_unit, scale_to_level

   !> Names of the intensity measures
   character(len=3), parameter :: im_names(1) = ['pga']

contains

   !> Check the name of an intensity measure
   subroutine check_im(im, error)
      !> Name
      character(len=*), intent(in) :: im
      !> Not one of im_names
      type(error_type), allocatable, intent(out) :: error

      if (.not. any(im == im_names)) &
         & call raise_input(error, 'im = '''//im//''': must be one of '//join(im_names))
   end subroutine check_im

   !> An intensity measure of a record as it stands
   pure function intensity(record, im) result(value)
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Name of the measure, one of im_names
      character(len=*), intent(in) :: im
      !> Its value, SI units
      real(wp) :: value

      value = 0.0_wp
      select case (im)
      case ('pga')
         value = record%pga()
      end select
   end function intensity

   !> What a level of 1 is in SI units: levels of accelerations are given in g
   pure function level_unit(im, gravity) result(unit)
      !> Name of the measure, one of im_names
      character(len=*), intent(in) :: im
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> SI units per level
      real(wp) :: unit

      unit = 1.0_wp
      select case (im)
      case ('pga')
         unit = gravity
      end select
   end function level_unit

   !> Factor that scales a record to a level of an intensity measure
   pure function scale_to_level(record, im, level, gravity) result(scale)
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Name of the measure, one of im_names
      character(len=*), intent(in) :: im
      !> Level, in g for accelerations
      real(wp), intent(in) :: level
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> The factor; 0 for a record without motion
      real(wp) :: scale

      real(wp) :: value

      scale = 0.0_wp
      value = intensity(record, im)
      if (value > 0.0_wp) scale = level*level_unit(im, gravity)/value
   end function scale_to_level

end module dondolo_intensity
