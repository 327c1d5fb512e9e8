!> Warnings as they are read: by people as sentences, by programs as JSON. The only place where a warning is worded.
module dondolo_case_warning_sentence
   use dondolo_base_json, only : json_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : find_property, hint_of, property_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_case_warning, only : warning_type, warnings_type
   use dondolo_fragility, only : least_ratio
   use dondolo_record_table, only : describe_pace, describe_pga
   use dondolo_wall_properties, only : gravity_property, wall_properties
   implicit none
   private

   public :: make_sentence, warning_sentences, warning_objects, put_warnings

contains

   !> The sentence of a warning
   subroutine make_sentence(warning, text)
      type(warning_type), intent(in) :: warning
      !> Its sentence, without a full stop
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: record, im, wall

      call warning%get_word('record', record)
      select case (warning%code)
      case ('value_below_usual', 'value_above_usual')
         call say_implausible(warning, text)
      case ('height_below_thickness', 'load_place_without_load', 'overlap_above_thickness')
         call warning%get_word('wall', wall)
         text = 'wall '''//wall//''': '
         select case (warning%code)
         case ('height_below_thickness')
            text = text//'the height is less than the thickness: are they swapped?'
         case ('load_place_without_load')
            text = text//'a bearing or an eccentricity without overburden changes nothing: is the overburden missing?'
         case default
            text = text//'interlock_overlap is more than the thickness of the wall: is it the length of a stone?'
         end select
         call count_walls(warning, text)
      case ('levels_above_usual')
         call warning%get_word('im', im)
         text = 'levels up to '//rounded(warning%value('largest'))//' of '//im//', more than '// &
            & to_text(warning%value('limit'))
         if (im == 'pgd' .or. im == 'hi') then
            text = text//' m: are they in cm?'
         else if (im(:min(2, len(im))) /= 'sa' .and. im /= 'pga') then
            text = text//' m/s: are they in cm/s?'
         else if (warning%value('largest') >= 10.0_wp) then
            text = text//' g: are they in m/s2, cm/s2 or per cent of g?'
         else
            text = text//' g: are they in m/s2 or cm/s2?'
         end if
      case ('record_without_motion')
         text = 'record '''//record//''' has a PGA of 0: it cannot be scaled and moves no wall'
      case ('records_without_event')
         text = 'the earthquake of '//to_text(warning%value('records_beyond'))//' of '//to_text(warning%value('records'))// &
            & ' records is not known (the first is '''//record//'''): standard errors take them as independent, and are too '// &
            & 'small if several are of one earthquake. The key, or the column of the catalogue, event names it'
      case ('record_pga', 'record_pgv_pga')
         if (warning%code == 'record_pga') call describe_pga(warning%value('pga_g'), warning%value('limit_g'), text)
         if (warning%code == 'record_pgv_pga') call describe_pace(warning%value('ratio_s'), warning%value('limit_s'), text)
         text = 'record '''//record//''': '//text
         if (warning%value('records') > 1.0_wp) text = text//' ('//to_text(warning%value('records_beyond'))//' of '// &
            & to_text(warning%value('records'))//' records)'
      case ('vertical_beyond_g')
         text = 'the ground accelerates downwards by more than g'
         if (warning%value('histories') > 0.0_wp) then
            text = text//' in '//to_text(warning%value('histories_beyond'))//' of '// &
               & to_text(warning%value('histories'))//' histories (record '''//record//''' from level '// &
               & rounded(warning%value('level'))//' on)'
         else
            text = text//' (record '''//record//''')'
         end if
         text = text//': it leaves the wall without support, which the model does not describe'
      case ('scale_factors_large')
         text = 'scale factors above '//to_text(warning%value('limit'))//' in '// &
            & to_text(warning%value('histories_beyond'))//' of '//to_text(warning%value('histories'))// &
            & ' histories, the largest '//rounded(warning%value('largest'))//' (record '''//record//''' at level '// &
            & rounded(warning%value('level'))//')'
      case ('factors_off_levels')
         call warning%get_word('im', im)
         text = 'factors that are given take records more than '//rounded(warning%value('limit'))//' % off their levels: '// &
            & to_text(warning%value('factors_beyond'))//' of '//to_text(warning%value('factors'))//'; record '''//record// &
            & ''' has '//im//' = '//rounded(warning%value('value'))//' at level '// &
            & rounded(warning%value('level'))
      case ('ill_conditioned')
         if (len(record) > 0) then
            text = 'ill-conditioned: '//to_text(warning%value('histories_beyond'))//' of '// &
               & to_text(warning%value('histories'))//' histories with an estimated error of the EDP above '// &
               & to_text(warning%value('limit'))//'; the largest is '//rounded(warning%value('largest'))// &
               & ' (record '''//record//''' at level '//rounded(warning%value('level'))//')'
         else
            text = 'ill-conditioned: the estimated error of the EDP is '//rounded(warning%value('largest'))//', above '// &
               & to_text(warning%value('limit'))
         end if
      case ('collapse_in_doubt')
         text = 'collapse or not is in doubt, by the estimated error'
         if (warning%value('histories') > 0.0_wp) text = text//', in '//to_text(warning%value('histories_in_doubt'))// &
            & ' of '//to_text(warning%value('histories'))//' histories'
      case ('one_level')
         text = 'only one level: no curve can be fitted, two at least are needed'
      case ('all_below_trigger')
         text = 'every history stays below the trigger: nothing moves, higher levels are needed'
      case ('one_record')
         text = 'only one record: its curve says nothing of other earthquakes and has no standard errors'
      case ('few_clusters')
         text = 'only '//to_text(warning%value('clusters'))//trim(merge(' cluster ', ' clusters', &
            & warning%value('clusters') < 2.0_wp))//' of '//to_text(warning%value('records'))//' records: standard '// &
            & 'errors need at least '//to_text(warning%value('limit'))
      case ('curves_without_fit', 'curves_extrapolated', 'curves_nearly_flat', 'population_without_fit', &
         & 'population_extrapolated', 'population_nearly_flat', 'union_without_fit', 'union_extrapolated', &
         & 'union_nearly_flat')
         call say_of_population(warning, text)
      case default
         call say_of_fit(warning, text)
      end select
   end subroutine make_sentence

   !> Of a value that no masonry has: the table of properties asks what may have happened
   subroutine say_implausible(warning, text)
      type(warning_type), intent(in) :: warning
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: wall, variable, unit, hint
      type(property_type) :: property

      call warning%get_word('wall', wall)
      call warning%get_word('variable', variable)
      call warning%get_word('unit', unit)
      if (len(unit) > 0) unit = ' '//unit
      text = 'wall '''//wall//''': '//variable//' = '//rounded(warning%value('value'))//unit
      property = gravity_property
      if (variable /= property%name) property = wall_properties(find_property(wall_properties, variable))
      if (warning%code == 'value_below_usual') then
         text = text//' is less than '//to_text(warning%value('limit'))//unit
      else
         text = text//' is more than '//to_text(warning%value('limit'))//unit
      end if
      hint = trim(hint_of(property, warning%value('value')))
      if (len(hint) > 0) text = text//': '//hint
      call count_walls(warning, text)
   end subroutine say_implausible

   !> Say of how many walls a warning is true
   subroutine count_walls(warning, text)
      type(warning_type), intent(in) :: warning
      !> Sentence of the first of them, to extend
      character(len=:), allocatable, intent(inout) :: text

      if (warning%value('walls') > 1.0_wp) text = text//' ('//to_text(warning%value('walls_beyond'))//' of '// &
         & to_text(warning%value('walls'))//' in all)'
   end subroutine count_walls

   !> Of the curve of one wall
   subroutine say_of_fit(warning, text)
      type(warning_type), intent(in) :: warning
      character(len=:), allocatable, intent(out) :: text

      character(len=*), parameter :: none = ', no curve is fitted: '
      character(len=:), allocatable :: levels

      levels = to_text(warning%value('first_level'))
      if (warning%value('levels') > 1.0_wp) levels = levels//' to '//to_text(warning%value('last_level'))
      select case (warning%code)
      case ('no_collapse')
         text = 'no collapse at levels '//levels//none//'the largest EDP is '//rounded(warning%value('largest_edp'))// &
            & ', higher levels are needed'
      case ('no_motion')
         text = 'no motion at levels '//levels//none//'the wall begins to rock at a PGA of '// &
            & rounded(warning%value('trigger_g'))//' g, higher levels are needed'
      case ('all_collapse')
         text = 'every history collapses at levels '//levels//none//'lower levels are needed'
      case ('single_level')
         text = 'only one level, '//levels//none//'two at least are needed'
      case ('decreasing')
         text = 'collapses do not become more frequent with the level'//none//'their trend is flat or falling'
      case ('not_converged')
         text = 'the fit does not converge at levels '//levels//', no curve is fitted'
      case ('separated')
         text = 'all collapses lie at levels above the survivals, or share one level with them'//none// &
            & 'the median lies '
         if (.not. warning%value('bracket_high') > 0.0_wp) then
            text = text//'above '//to_text(warning%value('bracket_low'))
         else if (.not. warning%value('bracket_low') > 0.0_wp) then
            text = text//'below '//to_text(warning%value('bracket_high'))
         else
            text = text//'between '//to_text(warning%value('bracket_low'))//' and '// &
               & to_text(warning%value('bracket_high'))
         end if
         text = text//', more levels there are needed'
      case ('nearly_flat')
         text = 'collapses hardly become more frequent with the level (likelihood ratio against no slope below '// &
            & rounded(least_ratio)//', its 95 % quantile): theta = '//rounded(warning%value('theta'))//' and beta = '// &
            & rounded(warning%value('beta'))//' are not reliable, levels farther apart or more records are needed'
      case default
         text = 'theta = '//rounded(warning%value('theta'))//' lies outside the levels '//levels//': the fit extrapolates'
      end select
   end subroutine say_of_fit

   !> Of the curves of a population
   subroutine say_of_population(warning, text)
      type(warning_type), intent(in) :: warning
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: wall, of, status, group, mechanism

      call warning%get_word('wall', wall)
      call warning%get_word('of', of)
      call warning%get_word('status', status)
      call warning%get_word('group', group)
      call warning%get_word('mechanism', mechanism)
      if (len(group) > 0) then
         group = 'group '''//group//''''
      else
         group = 'the population'
      end if
      select case (warning%code)
      case ('population_without_fit')
         text = group//' has no fit (mechanism '//mechanism//', status '//status//')'
      case ('population_extrapolated')
         text = 'the median of '//group//', '//rounded(warning%value('theta'))//' (mechanism '//mechanism// &
            & '), lies outside the levels: the fit extrapolates'
      case ('union_without_fit')
         text = 'the mechanisms of '''//wall//''' in the same histories have no fit (status '//status//')'
      case ('union_nearly_flat')
         text = 'the median of '''//wall//''', '//rounded(warning%value('theta'))//', is not reliable: the probability of '// &
            & 'collapse hardly increases with the level'
      case ('union_extrapolated')
         text = 'the median of the mechanisms of '''//wall//''' in the same histories, '//rounded(warning%value('theta'))// &
            & ', lies outside the levels: the fit extrapolates'
      case ('population_nearly_flat')
         text = 'the median of '//group//', '//rounded(warning%value('theta'))//' (mechanism '//mechanism// &
            & '), is not reliable: the probability of collapse hardly increases with the level'
      case default
         text = to_text(warning%value('curves'))//' of '//to_text(warning%value('of_curves'))//' '//of
         if (warning%value('curves') > 1.0_wp) then
            text = text//' have '
         else
            text = text//' has '
         end if
         if (warning%code == 'curves_extrapolated') then
            text = text//'a median outside the levels'
         else if (warning%code == 'curves_nearly_flat') then
            text = text//'collapses that hardly become more frequent with the level, so that theta and beta are not reliable'
         else if (warning%value('curves') > 1.0_wp) then
            text = text//'no fit and take part with their fractions of collapse, but not in dispersions'
         else
            text = text//'no fit and takes part with its fractions of collapse, but not in dispersions'
         end if
         text = text//' ('//status//'; the first is '''//wall//''')'
      end select
   end subroutine say_of_population

   !> The sentences of warnings
   subroutine warning_sentences(warnings, lines)
      type(warnings_type), intent(in) :: warnings
      !> Lines to add to
      type(lines_type), intent(inout) :: lines

      character(len=:), allocatable :: text
      integer :: i

      do i = 1, warnings%count
         call make_sentence(warnings%item(i), text)
         call lines%add(text)
      end do
   end subroutine warning_sentences

   !> Warnings as JSON objects, each on one line
   subroutine warning_objects(warnings, lines)
      type(warnings_type), intent(in) :: warnings
      !> Lines to add to
      type(lines_type), intent(inout) :: lines

      type(json_type) :: json
      character(len=:), allocatable :: text
      integer :: i

      do i = 1, warnings%count
         json = json_type(is_compact=.true.)
         call put_warning(warnings%item(i), json)
         call json%get(text)
         call lines%add(text)
      end do
   end subroutine warning_objects

   !> Put warnings into a JSON object, as an array `warnings`
   subroutine put_warnings(warnings, json)
      type(warnings_type), intent(in) :: warnings
      !> JSON, in an object
      type(json_type), intent(inout) :: json

      integer :: i

      call json%open_array('warnings')
      do i = 1, warnings%count
         call put_warning(warnings%item(i), json)
      end do
      call json%close_array()
   end subroutine put_warnings

   !> Put one warning as an object: its code, what it is about, its numbers and its sentence
   subroutine put_warning(warning, json)
      type(warning_type), intent(in) :: warning
      type(json_type), intent(inout) :: json

      character(len=:), allocatable :: text
      integer :: i

      call make_sentence(warning, text)
      call json%open_object()
      call json%put('code', trim(warning%code))
      call json%open_object('subject')
      do i = 1, warning%words
         call json%put(trim(warning%word(i)%name), warning%word(i)%text)
      end do
      call json%close_object()
      call json%open_object('numbers')
      do i = 1, warning%numbers
         call json%put(trim(warning%number(i)%name), warning%number(i)%value)
      end do
      call json%close_object()
      call json%put('sentence', text)
      call json%close_object()
   end subroutine put_warning

end module dondolo_case_warning_sentence
