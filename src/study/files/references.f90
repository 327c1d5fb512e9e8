!> The sources of what dondolo computes, as BibTeX: one list of them, each with what it is the source of.
!>
!> What a study has used is said in words: mechanisms, a mechanism with its model of restitution ('two_block/default'), intensity
!> measures without their periods ('sa'), engines, and the names below of methods. A source is cited by any of its words, or by its
!> key. A field that is not known is empty.
module dondolo_files_references
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_files_version, only : build_commit, dondolo_version_text
   implicit none
   private

   public :: list_bibtex, list_keys

   !> A source
   type :: reference_type
      !> Its key, and the type of its entry
      character(len=24) :: key
      character(len=13) :: kind
      !> Words of what it is the source of; empty: of all studies
      character(len=72) :: of
      character(len=128) :: author
      character(len=144) :: title
      !> Journal, book, report or place of publication
      character(len=96) :: published
      integer :: year
      !> Empty where it has none
      character(len=4) :: volume
      character(len=11) :: pages
   end type reference_type

   type(reference_type), parameter :: references(*) = [ &
      & reference_type('nale2021', 'inproceedings', '', &
      &   'Nale, Marco and Chiozzi, Andrea and Lamborghini, Riccardo and Minghini, Fabio and Rigolin, Marco and '// &
      &   'Tralli, Antonio', &
      &   'Fragility assessment of unreinforced masonry walls undergoing earthquake-induced local failure '// &
      &   'mechanisms', &
      &   'COMPDYN, Computational Methods in Structural Dynamics and Earthquake Engineering', 2021, '', ''), &
      & reference_type('baker2015', 'article', 'fit', &
      &   'Baker, Jack W.', &
      &   'Efficient analytical fragility function fitting using dynamic structural analysis', &
      &   'Earthquake Spectra', 2015, '31', '579--599'), &
      & reference_type('housner1963', 'article', 'one_sided free_standing corner free_standing/default', &
      &   'Housner, George W.', &
      &   'The behavior of inverted pendulum structures during earthquakes', &
      &   'Bulletin of the Seismological Society of America', 1963, '53', '403--417'), &
      & reference_type('sorrentino2011', 'article', 'one_sided/default one_sided/sorrentino', &
      &   'Sorrentino, Luigi and AlShawa, Omar and Decanini, Luis D.', &
      &   'The relevance of energy damping in unreinforced masonry rocking mechanisms. Experimental and analytic '// &
      &   'investigations', &
      &   'Bulletin of Earthquake Engineering', 2011, '9', '1617--1642'), &
      & reference_type('sorrentino2008', 'article', 'two_block', &
      &   'Sorrentino, Luigi and Masiani, Renato and Griffith, Michael C.', &
      &   'The vertical spanning strip wall as a coupled rocking rigid body assembly', &
      &   'Structural Engineering and Mechanics', 2008, '29', '433--453'), &
      & reference_type('graziotti2016', 'article', 'graziotti_2016', &
      &   'Graziotti, Francesco and Tomassetti, Umberto and Penna, Andrea and Magenes, Guido', &
      &   'Out-of-plane shaking table tests on {URM} single leaf and cavity walls', &
      &   'Engineering Structures', 2016, '125', '455--470'), &
      & reference_type('dormand1980', 'article', 'rk45', &
      &   'Dormand, J. R. and Prince, P. J.', &
      &   'A family of embedded {Runge-Kutta} formulae', &
      &   'Journal of Computational and Applied Mathematics', 1980, '6', '19--26'), &
      & reference_type('liang1986', 'article', 'clustered', &
      &   'Liang, Kung-Yee and Zeger, Scott L.', &
      &   'Longitudinal data analysis using generalized linear models', &
      &   'Biometrika', 1986, '73', '13--22'), &
      & reference_type('mancl2001', 'article', 'clustered', &
      &   'Mancl, Lloyd A. and DeRouen, Timothy A.', &
      &   'A covariance estimator for {GEE} with improved small-sample properties', &
      &   'Biometrics', 2001, '57', '126--134'), &
      & reference_type('mccullagh1980', 'article', 'ordinal', &
      &   'McCullagh, Peter', &
      &   'Regression models for ordinal data', &
      &   'Journal of the Royal Statistical Society, Series B', 1980, '42', '109--142'), &
      & reference_type('nigam1969', 'article', 'building hi sa saavg', &
      &   'Nigam, Navin C. and Jennings, Paul C.', &
      &   'Calculation of response spectra from strong-motion earthquake records', &
      &   'Bulletin of the Seismological Society of America', 1969, '59', '909--922'), &
      & reference_type('arias1970', 'incollection', 'arias arias-trapz', &
      &   'Arias, Arturo', &
      &   'A measure of earthquake intensity', &
      &   'Seismic Design for Nuclear Power Plants', 1970, '', '438--483'), &
      & reference_type('trifunac1975', 'article', 'd5-75 d5-95', &
      &   'Trifunac, Mihailo D. and Brady, A. Gerald', &
      &   'A study on the duration of strong earthquake ground motion', &
      &   'Bulletin of the Seismological Society of America', 1975, '65', '581--626'), &
      & reference_type('epri1988', 'misc', 'cav cav-trapz', &
      &   '{Electric Power Research Institute}', &
      &   'A criterion for determining exceedance of the operating basis earthquake', &
      &   'Report EPRI NP-5930', 1988, '', ''), &
      & reference_type('housner1952', 'inproceedings', 'hi', &
      &   'Housner, George W.', &
      &   'Spectrum intensities of strong-motion earthquakes', &
      &   'Symposium on Earthquake and Blast Effects on Structures', 1952, '', ''), &
      & reference_type('dimitrakopoulos2015', 'article', 'pga/a0 p*pgv/a0', &
      &   'Dimitrakopoulos, Elias G. and Paraskeva, Themelina S.', &
      &   'Dimensionless fragility curves for rocking response to near-fault excitations', &
      &   'Earthquake Engineering and Structural Dynamics', 2015, '44', '2015--2033'), &
      & reference_type('jalayer2017', 'article', 'cloud', &
      &   'Jalayer, Fatemeh and Ebrahimian, Hossein and Miano, Andrea and Manfredi, Gaetano and Sezen, Halil', &
      &   'Analytical fragility assessment using unscaled ground motion records', &
      &   'Earthquake Engineering and Structural Dynamics', 2017, '46', '2639--2663'), &
      & reference_type('vamvatsikos2002', 'article', 'incremental', &
      &   'Vamvatsikos, Dimitrios and Cornell, C. Allin', &
      &   'Incremental dynamic analysis', &
      &   'Earthquake Engineering and Structural Dynamics', 2002, '31', '491--514'), &
      & reference_type('zhang2001', 'article', 'overturning', &
      &   'Zhang, Jian and Makris, Nicos', &
      &   'Rocking response of free-standing blocks under cycloidal pulses', &
      &   'Journal of Engineering Mechanics', 2001, '127', '473--483'), &
      & reference_type('mckay1979', 'article', 'uncertainty', &
      &   'McKay, M. D. and Beckman, R. J. and Conover, W. J.', &
      &   'A comparison of three methods for selecting values of input variables in the analysis of output from a '// &
      &   'computer code', &
      &   'Technometrics', 1979, '21', '239--245'), &
      & reference_type('blatman2010', 'article', 'uncertainty', &
      &   'Blatman, G. and Sudret, B.', &
      &   'Efficient computation of global sensitivity indices using sparse polynomial chaos expansions', &
      &   'Reliability Engineering and System Safety', 2010, '95', '1216--1229'), &
      & reference_type('sabetta1996', 'article', 'synthetic', &
      &   'Sabetta, F. and Pugliese, A.', &
      &   'Estimation of response spectra and simulation of nonstationary earthquake ground motions', &
      &   'Bulletin of the Seismological Society of America', 1996, '86', '337--352'), &
      & reference_type('ntc2018', 'misc', 'check', &
      &   '{Ministero delle Infrastrutture e dei Trasporti}', &
      &   'D.M. 17.01.18, Aggiornamento delle {Norme Tecniche per le Costruzioni}', &
      &   'Italy', 2018, '', '')]

contains

   !> List the keys of the sources of what was used, in the order of the list
   subroutine list_keys(used, keys)
      !> Words of what was used, and keys; those without a source add none
      type(lines_type), intent(in) :: used
      type(lines_type), intent(out) :: keys

      integer :: i

      do i = 1, size(references)
         if (is_cited(references(i), used)) call keys%add(trim(references(i)%key))
      end do
   end subroutine list_keys

   !> List the lines of BibTeX of dondolo itself and of the sources of what was used
   subroutine list_bibtex(used, lines)
      !> Words of what was used, and keys
      type(lines_type), intent(in) :: used
      type(lines_type), intent(out) :: lines

      type(reference_type) :: one
      integer :: i

      call lines%add('@misc{dondolo,')
      call add_field('author', '{the dondolo contributors}')
      call add_field('title', 'dondolo: fragility of unreinforced masonry walls that rock and overturn in earthquakes')
      call add_field('year', '2026')
      call add_field('note', 'Version '//dondolo_version_text//', commit '//trim(build_commit()))
      call lines%add('}')
      do i = 1, size(references)
         if (.not. is_cited(references(i), used)) cycle
         one = references(i)
         call lines%add('')
         call lines%add('@'//trim(one%kind)//'{'//trim(one%key)//',')
         call add_field('author', trim(one%author))
         call add_field('title', trim(one%title))
         call add_field(place_of(one%kind), trim(one%published))
         call add_field('year', to_text(one%year))
         if (len_trim(one%volume) > 0) call add_field('volume', trim(one%volume))
         if (len_trim(one%pages) > 0) call add_field('pages', trim(one%pages))
         call lines%add('}')
      end do

   contains

      !> Add a field of an entry
      subroutine add_field(name, value)
         character(len=*), intent(in) :: name, value

         call lines%add('  '//trim(name)//' = {'//value//'},')
      end subroutine add_field

   end subroutine list_bibtex

   !> Is a source cited?
   pure logical function is_cited(reference, used)
      type(reference_type), intent(in) :: reference
      !> Words of what was used, and keys
      type(lines_type), intent(in) :: used

      integer :: i

      is_cited = len_trim(reference%of) == 0
      do i = 1, used%count
         associate (word => used%line(i)%text)
            is_cited = is_cited .or. index(' '//trim(reference%of)//' '//trim(reference%key)//' ', ' '//word//' ') > 0
         end associate
      end do
   end function is_cited

   !> Field that names where something was published
   pure character(len=12) function place_of(kind)
      !> Type of its entry
      character(len=*), intent(in) :: kind

      select case (kind)
      case ('article')
         place_of = 'journal'
      case ('misc')
         place_of = 'howpublished'
      case default
         place_of = 'booktitle'
      end select
   end function place_of

end module dondolo_files_references
