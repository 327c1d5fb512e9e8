"""Page of the site on the columns of the tables of results: what each means, in the order of the table."""

from dondolo.reporting.words import UNITS

# Columns that mean the same in every table that has them
COMMON = {
    "wall": "name of the wall",
    "mechanism": "mechanism of the wall",
    "group": "group in the population; empty: none",
    "im": "intensity measure, as in `&stripes`",
    "im_level": "level to which the records are scaled",
    "edp_threshold": "EDP from which on a history reaches the damage state; the largest is `edp_limit`, collapse",
    "histories": "number of histories at the level",
    "collapses": "number of these that reach `edp_threshold`, collapse or a lower damage state",
    "fraction": "`collapses` / `histories`",
    "theta": "median of the lognormal curve",
    "beta": "its dispersion, the standard deviation of the logarithm",
    "status": "[result of the fit](../files.md#status-of-a-fit)",
    "se_ln_theta": "standard error of ln theta",
    "se_beta": "standard error of beta",
    "cov_ln_theta_beta": "covariance of ln theta and beta",
    "errors": "[kind of standard errors](../files.md#kinds-of-standard-errors)",
    "clusters": "number of clusters of records; of walls for `few_walls` and `one_wall`",
    "degrees_of_freedom": "of Student's t in intervals: clusters - 1, or Satterthwaite's where walls count too",
}
_CERTIFIED = "[certify](../reading_a_curve.md#certified-histories)"
_SAME = None  # The meaning of COMMON

# What is to be said of a table, and its columns in order
TABLES: dict[str, tuple[str, dict[str, str | None]]] = {
    "walls": (
        "The properties of the wall and of its building come first, in the order and meaning of"
        " [Variables](variables.md); notes, columns of the table of walls that begin with `x_` or `note`, come last.",
        {
            "alpha_rad": "angle between the vertical and the line from the hinge to the centroid; of `two_block` that"
            " of its lower block",
            "p_rad_s": "frequency parameter",
            "trigger_acceleration_m_s2": "ground acceleration at which the wall begins to rock",
            "capacity_rad": "rotation of unstable equilibrium, the denominator of the EDP",
            "restitution": "angular velocity after an impact / before it",
            "weight": "weight of the wall in its population",
            "group": _SAME,
            "p_occ": "probability that the mechanism can occur",
            "support_share": "k of [moving supports](../theory.md#supports-that-move); only if any wall stands on a"
            " building",
            "support_tilt_1_s2": "τ; likewise",
            "facade": "its facade; only if any wall has one",
            "occurrence": "whether the mechanisms of the wall are `independent` or `exclusive`; only if any are"
            " exclusive",
            "alternative": "alternative of the mechanism; likewise",
        },
    ),
    "histories": (
        "",
        {
            "wall": _SAME,
            "mechanism": _SAME,
            "record": "name of the record",
            "polarity": "`as_recorded` or `reversed`",
            "im": _SAME,
            "im_level": _SAME,
            "scale": "factor on the record",
            "edp": "largest rotation / capacity; `edp_limit` for a collapse",
            "collapsed": "whether the history reaches `edp_limit`",
            "impacts": "impacts until the end of the record, without chains of bounces closed at once",
            "time_of_peak_s": "time of the largest rotation, or of the collapse",
            "edp_error": "estimated error of `edp`; only with `estimate_error` or `certify`",
            "status": f"only with {_CERTIFIED}: `double`, `quadruple` or `not_computable`",
            "edp_lowest": f"lower bound of the EDP, only with {_CERTIFIED}; another one than `edp_highest` only if"
            " `not_computable`",
            "edp_highest": "upper bound; likewise",
            "edp_rounded": "EDP with every sample of the record moved within half a unit of its last printed digit;"
            " likewise; empty: it is not known how the record was printed",
            "uplift": "whether the ground accelerates downwards by g or more at some instant; only of one wall under"
            " [vertical motion](../ground_motions.md#vertical-motion)",
        },
    ),
    "stripes": (
        "",
        {
            **dict.fromkeys(("wall", "mechanism", "im", "im_level", "histories", "collapses", "fraction")),
            "edp_threshold": _SAME,
            "uplift": "number of histories with `uplift`",
        },
    ),
    "fragility": (
        "",
        {
            **dict.fromkeys(("wall", "mechanism", "im", "theta", "beta", "se_ln_theta", "se_beta")),
            "log_likelihood": "at the maximum, binomial coefficients included",
            "status": _SAME,
            "bracket_low": "levels between which half of the histories begin to reach the threshold, from; empty: open",
            "bracket_high": "to; empty: open",
            "edp_threshold": _SAME,
            "theta_low": "95 % interval of theta, from",
            "theta_high": "to",
            "beta_low": "95 % interval of beta, from",
            "beta_high": "to",
            **dict.fromkeys(("errors", "clusters", "degrees_of_freedom")),
            "naive_se_ln_theta": "standard error of ln theta as if all histories were independent",
            "naive_se_beta": "likewise of beta",
            "cov_ln_theta_beta": _SAME,
            "deviance": "twice the difference from the log-likelihood of the fractions"
            " ([goodness of fit](../reading_a_curve.md#is-it-a-lognormal));"
            " of ordinal states that of all curves together",
            "deviance_dof": "levels less parameters",
        },
    ),
    "typology": (
        "`theta` and `beta` are those of the lognormal fitted to `mean_fraction` / `upper_asymptote`. Mechanisms of a"
        " wall"
        " are independent in this table.",
        {
            "mechanism": "mechanism; `all`: any of them",
            "im": _SAME,
            "im_level": _SAME,
            "weight": "sum of the weights of the walls; of one mechanism each counts as often as it can occur",
            "mean_fraction": "weighted mean of the fractions of the walls at the level",
            "mean_curve": "weighted mean of the curves of the walls at the level",
            **dict.fromkeys(("theta", "beta", "status")),
            "group": "group of the walls; empty: the whole population",
            "fractile_16": "probability that 16 % of the weight do not exceed at the level",
            "fractile_50": "50 %",
            "fractile_84": "84 %",
            "beta_walls": "dispersion between walls: weighted standard deviation of ln theta",
            "beta_records": "dispersion between records: weighted root mean square of beta",
            "upper_asymptote": "limit of the mean curve: share of the weight in which any mechanism can occur",
            "edp_threshold": _SAME,
            **dict.fromkeys(("se_ln_theta", "se_beta", "cov_ln_theta_beta", "errors", "clusters")),
            "degrees_of_freedom": _SAME,
        },
    ),
    "unions": (
        "The mechanisms of a wall or facade share their histories. The last rows, without a `wall`, are the means over"
        " the population or its `group`, without counts; their standard errors are over records and walls. In Python"
        " they are `Typology.unions` and `Typology.group_unions`.",
        {
            "wall": "name of the wall or the facade; empty: a mean",
            "group": "group; empty: none, or in rows of a mean the whole population",
            "mechanisms": "number of its mechanisms",
            "im": _SAME,
            "im_level": _SAME,
            "histories": _SAME,
            "collapses": "number of these in which any mechanism reaches `edp_threshold`, or its expectation where"
            " mechanisms may not occur",
            "fraction": _SAME,
            "independent_fraction": "1 - ∏ (1 - p f), as if the mechanisms were independent; of exclusive alternatives"
            " Σ p [1 - ∏ (1 - f)]",
            **dict.fromkeys(("edp_threshold", "theta", "beta", "status", "se_ln_theta", "se_beta")),
            **dict.fromkeys(("cov_ln_theta_beta", "errors", "clusters", "degrees_of_freedom")),
            "independent_theta": "as `theta`, of the fit to `independent_fraction`; so are the columns that follow",
            "independent_beta": "as `beta`",
            "independent_se_ln_theta": "as `se_ln_theta`",
            "independent_se_beta": "as `se_beta`",
            "independent_cov_ln_theta_beta": "as `cov_ln_theta_beta`",
            "independent_errors": "as `errors`",
            "independent_clusters": "as `clusters`",
            "independent_degrees_of_freedom": "as `degrees_of_freedom`",
        },
    ),
    "ties": (
        "",
        {
            **dict.fromkeys(("wall", "mechanism", "im", "im_level")),
            "tie": "number of the tie, in the order in which the wall has them",
            "histories": _SAME,
            "yielded": "number of these at whose end the tie has a plastic elongation",
            "broken": "number of these at whose end the tie is broken",
            "share_yielded": "`yielded` / `histories`",
            "share_broken": "`broken` / `histories`",
            "mean_plastic_elongation_m": "mean plastic elongation over the histories",
            "largest_plastic_elongation_m": "largest plastic elongation over the histories",
        },
    ),
    "designs": (
        "The curves are those of collapse. Designs are alternatives, so there is no mean over them and no"
        " `PREFIX_typology.csv`; `dondolo nrml` writes a function for each, and `Typology.are_alternatives` is true."
        " In Python the table is `read_results(PREFIX).designs`.",
        {
            "design": "name of the wall; the first is the one that all are compared with",
            **dict.fromkeys(("im", "theta", "beta", "se_ln_theta", "status")),
            "ratio": "theta / that of the first design",
            "ratio_low": "95 % interval of the ratio, from records in pairs",
            "ratio_high": "its end",
            "p_value": "of a ratio of 1",
            "steel_kg_m": "mass of its ties",
            "gain_per_kg": "relative gain of theta for each kg/m of steel above that of the first, m/kg",
            "alpha_0_g": "static capacity with its ties at yield",
            "static_ratio": "`alpha_0_g` / that of the first design",
            "alpha_0": "multiplier α₀ of its check; this and what follows is empty without `&check`",
            "a_0_m_s2": "acceleration a₀*",
            "zeta_e_linear": "safety index ζ_E of SLV by the linear check; empty where that check is not applicable",
            "zeta_e": "of the ultimate state by the nonlinear check",
            "return_period_capacity": "T_R,C of the latter, years; empty without `reference_life`",
            "return_period_bound": "`<` or `>` where that is only a bound",
            "alpha_0_change": "`alpha_0` less that of the first design; likewise below, empty for a bound",
            "a_0_change_m_s2": "of `a_0_m_s2`",
            "zeta_e_linear_change": "of `zeta_e_linear`",
            "zeta_e_change": "of `zeta_e`",
            "return_period_change": "of `return_period_capacity`",
        },
    ),
    "sources": (
        "The Sobol indices and their intervals are empty if too few variants have a curve.",
        {
            "source": "name of the property",
            "distribution": "its distribution, as in `&uncertainty`",
            "value_5": "its 5th percentile",
            "value_50": "its 50th percentile",
            "value_95": "its 95th percentile",
            "theta_5": "median with it at its 5th percentile and all others at their medians",
            "theta_95": "likewise at its 95th percentile",
            "first": "first-order Sobol index",
            "first_low": "its 95 % interval, from",
            "first_high": "to",
            "total": "total Sobol index",
            "total_low": "its 95 % interval, from",
            "total_high": "to",
        },
    ),
    "check": (
        "The rows are in the order of the calculation. Ties have a row each for bar, plate, strengths and forces"
        " ([ties](../ties.md#bar-plate-and-masonry)), and three that are 1 or 0: `hierarchy` (the bar yields before"
        " the anchor gives way), `plate_verified` and `anchor_checked`.",
        {
            "method": "`site`, `mechanism`, `tie`, `linear`, `nonlinear` or `dynamic`",
            "limit_state": "`SLD`, `SLV` or `SLC`; empty: all",
            "quantity": "name of the number. `ratio` is capacity / demand, `verified` 1 or 0, `applicable` 0 where the"
            " check does not apply to the wall, `probability` that of collapse by the curve, for the measure `pga`",
            "symbol": "its symbol",
            "value": "its value, in `unit`",
            "unit": "its unit",
            "formula": "place of its formula in the code",
            "meaning": "what it is, in words",
            "item": "part of the wall, `tie 1` ...; empty: the wall",
            "expression": "its formula in symbols; empty where it is given or has none",
            "numbers": "the same with numbers of eight digits, to be repeated by hand",
            "bound": "`<` or `>` where `value` is only a bound, as for return periods below 30 and above 2475 years",
        },
    ),
    "calculation": (
        "With these α₀, M* and e* can be repeated by hand. α₀ is the sum of `stabilising_nm_m` less that of"
        " `overturning_nm_m`, over that of `force_lever_nm_m`; M* is the square of the last, over g and the sum of"
        " `force_lever2_nm2_m`. Of a corner or a chain, whose forces are those of the whole, names end without `_m`:"
        " `force_n`, `stabilising_nm`, `force_lever2_nm2` ...",
        {
            "item": "`section 1` ..., from the bottom, and `masonry`, all of them as one body; `load 1` ..., `mass 1`"
            " ..., `thrust 1` ..., `tie 1` ..., `friction 1` ...; of a strip `lower block`, `upper block`,"
            " `load on top`",
            "force_n_m": "weight, force outwards, largest force of a tie",
            "depth_m": "depth behind the outer face",
            "arm_m": "rise for a unit of rotation at rest",
            "lever_m": "horizontal travel for a unit of rotation at rest",
            "stabilising_nm_m": "moment against the mechanism",
            "overturning_nm_m": "moment for the mechanism",
            "force_lever_nm_m": "weight times lever; empty for `masonry`, of which the sections have it",
            "force_lever2_nm2_m": "weight times lever squared; empty for the sections, which move as one body",
        },
    ),
    "checks": (
        "Capacities and ratios are empty if the check is not applicable.",
        {
            **dict.fromkeys(("wall", "mechanism", "group")),
            "alpha_0": "multiplier that starts the mechanism",
            "mass_ratio": "part of the mass that takes part, e*",
            "d_0_m": "displacement at which the capacity is zero",
            "linear_sld_g": "capacity a_g S by the linear check of SLD",
            "linear_sld_ratio": "capacity / demand",
            "linear_slv_g": "likewise, linear check of SLV",
            "linear_slv_ratio": "capacity / demand",
            "nonlinear_slv_g": "likewise, nonlinear check of SLV",
            "nonlinear_slv_ratio": "capacity / demand",
            "nonlinear_slc_g": "likewise, nonlinear check of SLC",
            "nonlinear_slc_ratio": "capacity / demand",
            "zeta_e": "safety index ζ_E of the wall: ratio of the nonlinear check of the ultimate state",
            "satisfied": "whether all that the verdict rests on is verified, and nothing is open of ties or hinges",
            "probability_site": "probability of collapse by the curve at a_g S of the site, for the measure `pga`",
            "probability_nonlinear_slv": "the same at `nonlinear_slv_g`",
            "anchors_checked": "whether all anchors of its ties are checked; empty: not asked",
            "hierarchy": "whether all bars yield before them; empty: not asked",
            "plates_verified": "whether all plates are thick enough; empty: not asked",
            "note": "why the row was not checked",
        },
    ),
    "history": (
        "The comment lines repeat `history` of the run.",
        {
            "time_s": "time from the first sample on",
            "ground_acceleration_m_s2": "scaled horizontal acceleration of the ground, or for a wall on a building that"
            " of its supports",
            "rotation_rad": "rotation, positive to side 1",
            "velocity_rad_s": "angular velocity",
            "edp": "absolute rotation / capacity",
            "side": "1 or -1, the side to which the wall leans; at rest that of the last motion",
            "after_impact": "1 just after an impact; the row before it, of the same time, is just before",
        },
    ),
}
HEAD = """# Columns of the tables

What each column of the [tables of a run](../files.md#the-tables-of-a-run) means. A cell without a value is empty. Yes
and no are 1 and 0. The unit of a level, and of theta, is that of `im`: the header of the table names it, and
`unit_of_levels` of the run.
"""


def page() -> str:
    """The page."""
    lines = [HEAD]
    for name, (note, columns) in TABLES.items():
        lines += [f"## `PREFIX_{name}.csv`", "", *([note, ""] if note else [])]
        lines += ["| column | unit | meaning |", "|---|---|---|"]
        for column, meaning in columns.items():
            unit = next((unit for ending, unit in UNITS.items() if column.endswith(ending)), "")
            lines.append(f"| `{column}` | {unit} | {meaning or COMMON[column]} |")
        lines.append("")
    return "\n".join(lines)
