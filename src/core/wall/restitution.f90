!> Restitution: which model, times which factor, gives which speed ratio at an impact.
module dondolo_wall_restitution
   use dondolo_base_error, only : error_type, not_a_word, not_given, not_together, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : choices_length
   use dondolo_base_text, only : brief, join, to_text
   use dondolo_base_unit_hint, only : unit_question
   implicit none
   private

   public :: impact_models_type, restitution_type
   public :: restitution_models, published_factors, published_factor_type, cut_off

   !> Names of the models
   character(len=choices_length), parameter :: restitution_models(*) = &
      & [character(len=choices_length) :: 'default', 'sorrentino', 'impulse']

   !> What tests gave for the measured speed ratio / that of the model
   type :: published_factor_type
      !> Name by which it is asked for
      character(len=16) :: name
      !> Distribution, 'uniform' or 'normal', and its parameters: the smallest and the largest value, or mean and standard deviation
      character(len=8) :: kind
      real(wp) :: parameters(2)
      !> Mechanism that it is of
      character(len=16) :: mechanism
      !> Model whose speed ratio the measured ones were divided by
      character(len=choices_length) :: model
      !> What was tested, and who did
      character(len=170) :: source
   end type published_factor_type

   !> Ranges of restitution_factor that were measured, or that measured values lie in
   type(published_factor_type), parameter :: published_factors(*) = [ &
      & published_factor_type('graziotti_2016', 'uniform', [0.84_wp, 0.90_wp], 'two_block', 'sorrentino', &
      &   'two-block walls of brick, Graziotti, Tomassetti, Penna and Magenes (2016): 0.84 to 0.90 of the value '// &
      &   'predicted by equation (4)'), &
      & published_factor_type('elgawady_2010', 'uniform', [0.90_wp, 1.00_wp], 'free_standing', 'impulse', 'blocks on '// &
      &   'concrete, ElGawady, Ma, Butterworth and Ingham (2010): 0.95 and 0.97 of Housner''s value; the width is an '// &
      &   'assumption'), &
      & published_factor_type('colombo_2025', 'normal', [0.990_wp, 0.018_wp], 'free_standing', 'impulse', 'blocks of '// &
      &   'limestone, Colombo, Vlachakis, Giouvanidis and Lourenco (2025): mean ratio to Housner''s value of 134 '// &
      &   'trials, and its standard deviation between slendernesses')]

   !> Speed ratio that a published normal distribution reaches at most: a ratio of 1 is refused, and just below it motions hardly
   !> lose energy
   real(wp), parameter :: largest_ratio = 0.999_wp

   !> Where a published normal distribution ends on both sides [standard deviations]
   real(wp), parameter :: widest = 3.0_wp

   !> Speed ratio of the impacts of a wall by each model; not allocated: its mechanism does not have the model
   type :: impact_models_type
      real(wp), allocatable :: sorrentino, impulse
      !> Is a coefficient of the wrong sign a plastic impact? Else it is refused
      logical :: may_be_plastic = .true.
   contains
      !> Which of them 'default' is
      procedure :: default
   end type impact_models_type

   !> What the user asks of the impacts
   type :: restitution_type
      !> Model, one of restitution_models
      character(len=:), allocatable :: model
      !> Speed ratio by number, instead of a model, 0 <= value < 1; not allocated: not given
      real(wp), allocatable :: value
      !> Factor on the speed ratio of every model
      real(wp) :: factor = 1.0_wp
   contains
      !> The speed ratio of an impact
      procedure :: speed_ratio
   end type restitution_type

contains

   !> Parameters of a published distribution for walls: of a normal one mean, standard deviation, and two ends as far from the mean
   !> as the largest speed ratio allows. Were it cut off above alone, its mean would be lower, which makes walls stronger
   pure function cut_off(number, coefficient) result(parameters)
      !> Number of the distribution in published_factors
      integer, intent(in) :: number
      !> Largest coefficient that its model gives one of the walls
      real(wp), intent(in) :: coefficient
      !> As of the distribution of its kind
      real(wp), allocatable :: parameters(:)

      real(wp) :: mean, sd, half

      parameters = published_factors(number)%parameters
      if (published_factors(number)%kind /= 'normal') return
      mean = parameters(1)
      sd = parameters(2)
      half = widest*sd
      if (coefficient > 0.0_wp) half = min(half, largest_ratio/coefficient - mean)
      parameters = [mean, sd, mean - half, mean + half]
   end function cut_off

   !> Name of the model that 'default' is: 'sorrentino' where there is one
   pure function default(self) result(model)
      class(impact_models_type), intent(in) :: self
      !> One of restitution_models
      character(len=choices_length) :: model

      model = 'impulse'
      if (allocated(self%sorrentino)) model = 'sorrentino'
   end function default

   !> Speed after an impact / speed before it: the model's value, or the number given, times the factor. A coefficient of the
   !> wrong sign (squat walls) means a plastic impact (docs/theory.md, section 3), but of a corner and of wedges it is refused.
   !> Ranges of value and factor are those of their properties (dondolo_wall_properties)
   subroutine speed_ratio(self, models, ratio, error)
      !> What the user asks
      class(restitution_type), intent(in) :: self
      !> What its mechanism has
      type(impact_models_type), intent(in) :: models
      !> Speed ratio e, 0 <= e < 1
      real(wp), intent(out) :: ratio
      !> A model that the mechanism does not have, or beside a number; a ratio of 1 or more; a model that has no ratio for the wall
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: model
      real(wp), allocatable :: coefficient

      ratio = 0.0_wp
      model = self%model
      if (model == 'default') model = trim(models%default())
      if (allocated(self%value) .and. self%model /= 'default') then
         call raise_input(error, 'restitution_value = '//to_text(self%value)//': give either it or restitution', &
            & not_together, 'restitution_value')
         return
      else if (allocated(self%value)) then
         coefficient = self%value
      else if (.not. (allocated(models%sorrentino) .or. allocated(models%impulse))) then
         call raise_input(error, 'restitution_value: must be given, the mechanism has no model of its impacts', &
            & not_given, 'restitution_value')
         return
      end if
      if (.not. allocated(coefficient)) then
         select case (model)
         case ('sorrentino')
            if (allocated(models%sorrentino)) coefficient = models%sorrentino
         case ('impulse')
            if (allocated(models%impulse)) coefficient = models%impulse
         end select
      end if
      if (.not. allocated(coefficient)) then
         call raise_input(error, 'restitution = '''//self%model//''': must be one of '// &
            & join(pack(restitution_models, [.true., allocated(models%sorrentino), allocated(models%impulse)])), &
            & not_a_word, 'restitution')
         return
      end if
      if (.not. (allocated(self%value) .or. models%may_be_plastic .or. coefficient > 0.0_wp)) then
         call raise_input(error, 'restitution_value: must be given, the model '''//model//''' gives the restitution e of an '// &
            & 'impact as '//brief(coefficient)//', it must be more than 0', not_given, 'restitution_value')
         return
      end if
      ratio = max(0.0_wp, self%factor*coefficient)
      if (.not. (allocated(self%value) .or. ratio < 1.0_wp .or. coefficient < 1.0_wp)) then
         call raise_input(error, 'restitution_value: must be given, the model '''//model//''' gives the restitution e of an '// &
            & 'impact as '//brief(coefficient)//', it must be less than 1', not_given, 'restitution_value')
         ratio = 0.0_wp
      else if (.not. ratio < 1.0_wp) then
         call raise_input(error, 'restitution_factor = '//to_text(self%factor)// &
            & ': makes the restitution e of an impact '//brief(ratio)//', must be less than 1'// &
            & trim(unit_question('', self%factor, 0.1_wp, 1.2_wp, 0.9_wp)), out_of_range, 'restitution_factor')
         ratio = 0.0_wp
      end if
   end subroutine speed_ratio

end module dondolo_wall_restitution
