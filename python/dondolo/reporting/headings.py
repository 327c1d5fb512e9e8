"""Italian of the tables of results: sheets, columns and the words of their cells, by their names.

Names are those of docs/files.md. What a user has named, identifiers of a case and formulas are not translated.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from dondolo.reporting.relazione.terms import MEANINGS, MECHANISMS, item_in_words
from dondolo.reporting.statuses import FITS

SHEETS = {
    "case": "caso",
    "walls": "pareti",
    "histories": "analisi",
    "stripes": "strisce",
    "fragility": "fragilità",
    "typology": "tipologia",
    "unions": "unioni",
    "ties": "catene",
    "check": "verifica",
    "checks": "verifiche",
    "calculation": "calcolo",
    "designs": "progetti",
    "sources": "incertezze",
    "history": "storia",
    "alternatives": "alternative",
    "variants": "varianti",
}

# Units that names of columns end with
UNITS = {
    "_kg_m3": "kg/m³",
    "_m_s2": "m/s²",
    "_nm2_m": "N m²/m",
    "_nm_m": "N m/m",
    "_n_m": "N/m",
    "_m2_m": "m²/m",
    "_j_m": "J/m",
    "_kg_m": "kg/m",
    "_rad_s": "rad/s",
    "_1_s2": "1/s²",
    "_rad": "rad",
    "_pa": "Pa",
    "_km": "km",
    "_m": "m",
    "_s": "s",
    "_g": "g",
}

COLUMNS = {
    # Of a case
    "group": "gruppo",
    "variable": "variabile",
    "value": "valore",
    # Whose
    "wall": "parete",
    "mechanism": "meccanismo",
    "mechanisms": "meccanismi",
    "design": "progetto",
    "facade": "facciata",
    "tie": "catena",
    "record": "accelerogramma",
    "polarity": "verso",
    "source": "sorgente d'incertezza",
    "distribution": "distribuzione",
    "weight": "peso statistico",
    "p_occ": "probabilità che il meccanismo sia possibile",
    "occurrence": "compresenza",
    "alternative": "alternativa",
    "upper_asymptote": "quota che può collassare",
    # Levels and counts
    "im": "misura d'intensità",
    "im_level": "livello d'intensità",
    "scale": "fattore di scala",
    "histories": "analisi",
    "collapses": "collassi",
    "collapsed": "collasso",
    "fraction": "frazione",
    "edp": "rotazione massima su capacità",
    "edp_threshold": "soglia della rotazione massima su capacità",
    "edp_error": "errore stimato della rotazione massima",
    "impacts": "urti",
    "time_of_peak": "istante del massimo",
    "uplift": "sollevamento",
    "certified": "certificazione",
    "independent_fraction": "frazione, meccanismi indipendenti",
    "mean_fraction": "media delle frazioni",
    "mean_curve": "media delle curve",
    "fractile_16": "frattile 16 %",
    "fractile_50": "frattile 50 %",
    "fractile_84": "frattile 84 %",
    "records": "accelerogrammi",
    "level": "quota",
    # Curves
    "theta": "mediana θ",
    "beta": "dispersione β",
    "se_ln_theta": "errore standard di ln θ",
    "se_beta": "errore standard di β",
    "cov_ln_theta_beta": "covarianza di ln θ e β",
    "naive_se_ln_theta": "errore standard di ln θ, analisi indipendenti",
    "naive_se_beta": "errore standard di β, analisi indipendenti",
    "log_likelihood": "log-verosimiglianza",
    "deviance": "devianza",
    "deviance_dof": "gradi di libertà della devianza",
    "status": "stato della stima",
    "bracket_low": "mediana non minore di",
    "bracket_high": "mediana non maggiore di",
    "errors": "errori standard",
    "clusters": "terremoti",
    "degrees_of_freedom": "gradi di libertà",
    "theta_low": "θ, inizio intervallo 95 %",
    "theta_high": "θ, fine intervallo 95 %",
    "beta_low": "β, inizio intervallo 95 %",
    "beta_high": "β, fine intervallo 95 %",
    "beta_walls": "β tra le pareti",
    "beta_records": "β tra gli accelerogrammi",
    "theta_lowest": "θ minima",
    "theta_greatest": "θ massima",
    "independent_theta": "θ, meccanismi indipendenti",
    "independent_beta": "β, meccanismi indipendenti",
    "independent_se_ln_theta": "errore standard di ln θ, meccanismi indipendenti",
    "independent_se_beta": "errore standard di β, meccanismi indipendenti",
    "independent_cov_ln_theta_beta": "covarianza di ln θ e β, meccanismi indipendenti",
    "independent_errors": "errori standard, meccanismi indipendenti",
    "independent_clusters": "terremoti, meccanismi indipendenti",
    "independent_degrees_of_freedom": "gradi di libertà, meccanismi indipendenti",
    # Sources of uncertainty
    "value_5": "valore al 5 %",
    "value_50": "valore al 50 %",
    "value_95": "valore al 95 %",
    "theta_5": "θ al 5 %",
    "theta_95": "θ al 95 %",
    "first": "indice di primo ordine",
    "first_low": "primo ordine, inizio intervallo",
    "first_high": "primo ordine, fine intervallo",
    "total": "indice totale",
    "total_low": "totale, inizio intervallo",
    "total_high": "totale, fine intervallo",
    # Designs
    "ratio": "rapporto delle mediane",
    "ratio_low": "rapporto, inizio intervallo 95 %",
    "ratio_high": "rapporto, fine intervallo 95 %",
    "p_value": "p di nessuna differenza",
    "steel": "acciaio",
    "gain_per_kg": "guadagno per kg/m",
    "static_ratio": "rapporto delle accelerazioni statiche",
    "zeta_e_linear": "ζ_E, SLV lineare",
    "zeta_e": "ζ_E, non lineare",
    "return_period_capacity": "T_R,C [anni]",
    "return_period_bound": "T_R,C, estremo",
    "alpha_0_change": "Δα₀",
    "a_0_change": "Δa₀*",
    "zeta_e_linear_change": "Δζ_E, SLV lineare",
    "zeta_e_change": "Δζ_E, non lineare",
    "return_period_change": "ΔT_R,C [anni]",
    # Checks
    "method": "metodo",
    "limit_state": "stato limite",
    "quantity": "grandezza",
    "symbol": "simbolo",
    "unit": "unità",
    "formula": "riferimento",
    "meaning": "significato",
    "item": "elemento",
    "expression": "espressione",
    "numbers": "valori sostituiti (SI)",
    "bound": "estremo",
    "alpha_0": "α₀",
    "mass_ratio": "frazione di massa partecipante e*",
    "d_0": "d₀*",
    "a_0": "a₀*",
    "linear_sld": "capacità a_g S, SLD lineare",
    "linear_sld_ratio": "capacità/domanda, SLD lineare",
    "linear_slv": "capacità a_g S, SLV lineare",
    "linear_slv_ratio": "capacità/domanda, SLV lineare",
    "nonlinear_slv": "capacità a_g S, SLV non lineare",
    "nonlinear_slv_ratio": "capacità/domanda, SLV non lineare",
    "nonlinear_slc": "capacità a_g S, SLC non lineare",
    "nonlinear_slc_ratio": "capacità/domanda, SLC non lineare",
    "probability_site": "probabilità di collasso per a_g S del sito",
    "probability_nonlinear_slv": "probabilità di collasso alla capacità SLV non lineare",
    "anchors_checked": "ancoraggi verificati",
    "hierarchy": "gerarchia rispettata",
    "plates_verified": "piastre sufficienti",
    "note": "nota",
    "force": "forza",
    "depth": "profondità",
    "arm": "braccio",
    "stabilising": "momento stabilizzante",
    "overturning": "momento ribaltante",
    "force_lever": "P z",
    "force_lever2": "P z²",
    "lever": "altezza del braccio",
    # Ties
    "yielded": "analisi con snervamento",
    "broken": "analisi con rottura",
    "share_yielded": "quota con snervamento",
    "share_broken": "quota con rottura",
    "mean_plastic_elongation": "allungamento plastico medio",
    "largest_plastic_elongation": "allungamento plastico massimo",
    # Histories
    "time": "tempo",
    "ground_acceleration": "accelerazione del suolo",
    "rotation": "rotazione",
    "velocity": "velocità",
    "side": "verso della rotazione",
    "after_impact": "dopo un urto",
    # Walls
    "height": "altezza",
    "thickness": "spessore",
    "density": "densità",
    "hinge": "quota della cerniera su altezza",
    "restitution_model": "modello di restituzione",
    "restitution_value": "coefficiente di restituzione dato",
    "restitution_factor": "fattore di restituzione",
    "restitution": "coefficiente di restituzione",
    "overburden": "carico in sommità",
    "overburden_inertia": "quota inerziale del carico in sommità",
    "eccentricity": "eccentricità del carico",
    "alpha": "snellezza",
    "p": "parametro di frequenza",
    "trigger_acceleration": "accelerazione di attivazione",
    "capacity": "rotazione di collasso",
    "hinge_depth": "arretramento della cerniera",
    "compressive_strength": "resistenza a compressione",
    "stress_block": "distribuzione delle tensioni",
    "hinge_at": "quote delle cerniere",
    "period": "periodo del modo",
    "damping": "smorzamento del modo",
    "participation": "partecipazione del modo",
    "storeys": "piani",
    "building_height": "altezza dell'edificio",
    "top_displacement": "spostamento della sommità dell'edificio",
    "support_share": "quota dell'accelerazione relativa degli appoggi",
    "support_tilt": "inclinazione per spostamento relativo degli appoggi",
    "level_top": "quota della sommità",
    "section_height": "altezza del tratto",
    "section_thickness": "spessore del tratto",
    "section_base_width": "larghezza alla base del tratto",
    "section_top_width": "larghezza in sommità del tratto",
    "load": "carico",
    "load_depth": "profondità del carico",
    "load_height": "quota del carico",
    "load_inertia": "inerzia del carico",
    "thrust": "spinta",
    "thrust_height": "quota della spinta",
    "thrust_depth": "profondità della spinta",
    "tie_height": "quota della catena",
    "tie_depth": "profondità della catena",
    "tie_area": "area della catena",
    "tie_bar": "diametro della barra della catena",
    "tie_spacing": "interasse delle barre della catena",
    "tie_length": "lunghezza della catena",
    "tie_modulus": "modulo elastico della catena",
    "tie_strength": "snervamento della catena",
    "tie_preload": "pretensione della catena",
    "tie_strain": "deformazione ultima della catena",
    "tie_anchor_force": "resistenza dell'ancoraggio della catena",
    "tie_plate_width": "larghezza della piastra della catena",
    "tie_plate_height": "altezza della piastra della catena",
    "tie_plate_thickness": "spessore della piastra della catena",
    "tie_plate_diameter": "diametro della piastra della catena",
    "masonry_compression": "resistenza a compressione alle piastre",
    "masonry_shear": "resistenza a taglio",
    "masonry_tension": "resistenza a trazione",
}

# Words of cells, by column
WORDS: Mapping[str, Mapping[str, str]] = {
    "mechanism": MECHANISMS | {"all": "tutti"},
    "status": FITS,
    "method": {
        "site": "sito",
        "mechanism": "meccanismo",
        "tie": "catena",
        "linear": "lineare",
        "nonlinear": "non lineare",
        "dynamic": "dinamica",
    },
    "polarity": {"as_recorded": "come registrato", "reversed": "invertito", "1": "1", "-1": "-1"},
    "errors": {"clustered": "per terremoto", "naive": "analisi indipendenti", "none": "nessuno"},
    "expression": {
        "where ties break": "dove si rompono le catene",
        "where a seat is lost": "dove un carico perde l'appoggio",
    },
    "unit": {"year": "anni"},
    "load_inertia": {"both": "orizzontale e verticale", "vertical": "verticale", "none": "nessuna"},
    "restitution_model": {"default": "predefinito"},
    "restitution": {"default": "predefinito"},
}
_PART = re.compile(r"^([a-z]+?)(\d+)(_.*)?$")


def heading(name: str) -> str:
    """The head of a column: its words, the number of the part that it is of, and its unit."""
    found = _PART.match(name)
    number, plain = (f" {found[2]}", f"{found[1]}{found[3] or ''}") if found and name not in COLUMNS else ("", name)
    if plain in COLUMNS:
        return COLUMNS[plain] + number
    for ending, unit in UNITS.items():
        words = plain.removesuffix(ending)
        if words != plain and words in COLUMNS:
            return f"{COLUMNS[words]}{number} [{unit}]"
    return name


def in_words(name: str, value: str) -> str:
    """A cell of a column of words."""
    if name == "item":
        return item_in_words(value)
    found = _PART.match(name)
    plain = f"{found[1]}{found[3] or ''}" if found else name.removeprefix("independent_")
    return WORDS.get(plain, {}).get(value, value)


def meaning(quantity: str, english: str) -> str:
    """What a number of the sheet of a check is."""
    return MEANINGS.get(quantity, english)
