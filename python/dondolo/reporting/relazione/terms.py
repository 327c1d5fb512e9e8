"""Italian of what has a key: quantities of the sheet of a check, items of a calculation, statuses of fits, warnings.

English sentences are those of the library. Nothing translates sentences: a warning is worded from its numbers.
"""

from __future__ import annotations

from collections import defaultdict

from dondolo.errors import DondoloWarning
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import number
from dondolo.reporting.statuses import FITS, STATUSES

# Quantities of the sheet
MEANINGS = {
    "ag": "accelerazione di picco su suolo rigido e orizzontale",
    "f0": "massima amplificazione su tale suolo",
    "tc_star": "periodo d'inizio del tratto a velocità costante su tale suolo",
    "stratigraphy": "coefficiente di sottosuolo",
    "topography": "coefficiente topografico",
    "tb": "periodo d'inizio del tratto ad accelerazione costante nel sito",
    "td": "periodo d'inizio del tratto a spostamento costante nel sito",
    "eta": "fattore di smorzamento",
    "reference_life": "periodo di riferimento",
    "return_period_demand": "periodo di ritorno della domanda",
    "return_period_capacity": "periodo di ritorno della capacità, lungo le pericolosità degli stati limite",
    "extrapolated": "capacità fuori dalle pericolosità degli stati limite: 1 sì, 0 no",
    "zeta_e": "indice di sicurezza sismica del meccanismo locale",
    "bar": "diametro della barra",
    "spacing": "interasse delle barre",
    "yield_stress": "tensione di snervamento di barra e piastra",
    "plate_width": "larghezza della piastra",
    "plate_height": "altezza della piastra",
    "plate_diameter": "diametro della piastra",
    "masonry_thickness": "spessore della muratura interessata",
    "edge_distance": "distanza tra piastra e sommità della parete",
    "anchor_knowledge": "fattore di confidenza delle resistenze della muratura",
    "bearing_strength": "resistenza di progetto sotto la piastra",
    "shear_strength": "resistenza a taglio di progetto",
    "tensile_strength": "resistenza a trazione di progetto",
    "friction_stress": "attrito sulle facce orizzontali",
    "bar_force": "snervamento della barra",
    "bearing_force": "schiacciamento della muratura",
    "shear_force": "punzonamento a taglio della muratura",
    "cone_force": "tronco di piramide di estrazione",
    "band_force": "estrazione di una fascia continua tra le piastre",
    "anchor_force": "resistenza dell'ancoraggio",
    "bar_force_per_m": "snervamento della barra, per metro",
    "anchor_force_per_m": "resistenza dell'ancoraggio, per metro",
    "tie_force_per_m": "forza massima della catena, per metro",
    "plate_needed": "spessore necessario della piastra",
    "plate_thickness": "spessore della piastra",
    "plate_verified": "spessore della piastra sufficiente: 1 sì, 0 no",
    "hierarchy": "gerarchia delle resistenze rispettata: 1 sì, 0 no",
    "anchor_checked": "resistenza dell'ancoraggio calcolata con un FC non minore di quello della verifica, o assegnata:"
    " 1 sì, 0 no",
    "applicable": "verifica applicabile: 0 no, rottura fragile dell'ancoraggio",
    "soil_factor": "coefficiente di sottosuolo e topografico, prodotto di S_S e S_T",
    "tc": "periodo d'inizio del tratto a velocità costante nel sito",
    "pga": "accelerazione di picco nel sito",
    "floor_pga": "accelerazione di picco alla quota della parete",
    "knowledge_factor": "fattore di confidenza",
    "behaviour": "fattore di comportamento",
    "alpha_0": "moltiplicatore di attivazione del meccanismo",
    "mass": "massa partecipante",
    "mass_ratio": "frazione di massa partecipante",
    "a_0": "accelerazione spettrale di attivazione",
    "d_0": "spostamento per cui il moltiplicatore si annulla",
    "weakest_hinge": "quota relativa della cerniera per cui il moltiplicatore di attivazione è minimo",
    "weakest_alpha_0": "moltiplicatore per tale cerniera",
    "level": "quota rispetto al suolo dello spettro di domanda",
    "diaphragm_period": "periodo del solaio deformabile in sommità, non compreso nella domanda",
    "tie_fracture": "spostamento per cui si rompono le catene che danno più di metà della resistenza",
    "capacity_ag": "capacità in termini di accelerazione su suolo rigido",
    "capacity_pga": "capacità in termini di accelerazione di picco nel sito",
    "displacement": "capacità di spostamento",
    "acceleration": "accelerazione spettrale di capacità per tale spostamento",
    "period": "periodo secante",
    "damping": "smorzamento equivalente",
    "spectral_demand": "accelerazione spettrale alla quota della parete",
    "demand": "domanda di spostamento",
    "ratio": "rapporto capacità/domanda",
    "records": "accelerogrammi",
    "histories": "analisi dinamiche con l'accelerazione di picco del sito",
    "beyond": "di esse oltre lo spostamento di collasso (nessuna è ammessa)",
    "mean_displacement": "media degli spostamenti massimi",
    "verified": "esito",
    "probability": "probabilità di collasso con la curva di fragilità",
}

# Items of the calculation
ITEMS = {
    "section": "tratto",
    "masonry": "muratura, corpo rigido unico",
    "load": "carico",
    "mass": "massa trattenuta",
    "thrust": "spinta",
    "tie": "catena",
    "friction": "attrito",
    "lower block": "blocco inferiore",
    "upper block": "blocco superiore",
    "load on top": "carico in sommità",
}

MECHANISMS = {
    "one_sided": "ribaltamento semplice verso l'esterno",
    "free_standing": "parete libera, oscillazione sui due lati",
    "two_block": "flessione verticale",
}

_NO_CURVE = "nessuna curva di fragilità per la parete {wall}: "
# Warnings by their codes, with their subjects and numbers
WARNINGS = {
    "value_below_usual": "il valore {value} di {variable} è minore di {limit}: unità di misura da controllare",
    "value_above_usual": "il valore {value} di {variable} è maggiore di {limit}: unità di misura da controllare",
    "height_below_thickness": "parete {wall}: altezza minore dello spessore, dati forse scambiati",
    "load_place_without_load": "parete {wall}: posizione di un carico sovrastante nullo",
    "overlap_above_thickness": "parete {wall}: ammorsamento maggiore dello spessore della parete ortogonale",
    "levels_above_usual": "livelli fino a {largest} di {im}, oltre il limite usuale {limit}: unità di misura da"
    " controllare",
    "record_without_motion": "accelerogramma {record}: accelerazione di picco nulla",
    "probabilities_sum_to_one": "parete {wall}: le probabilità dei suoi meccanismi hanno somma 1, ma sono indipendenti:"
    " da controllare se i meccanismi si escludono a vicenda (occurrence = 'exclusive')",
    "records_without_event": "terremoto non indicato per {records_beyond} accelerogrammi su {records}: gli"
    " errori standard li"
    " considerano indipendenti",
    "record_pga": "accelerogramma {record}: accelerazione di picco {pga_g} g fuori dal campo usuale (limite"
    " {limit_g} g)",
    "record_start": "accelerogramma {record}: la prima accelerazione è {share} volte quella di picco (limite {limit}):"
    " da controllare se la registrazione è tagliata",
    "record_pgv_pga": "accelerogramma {record}: rapporto PGV/PGA di {ratio_s} s fuori dal campo usuale (limite"
    " {limit_s} s)",
    "records_pgv_pga": "mediana del rapporto PGV/PGA di {records} accelerogrammi di {median_s} s, sotto il limite"
    " {limit_s} s: da controllare il passo temporale, {dt_s} s per {record}",
    "vertical_beyond_g": "accelerazione verticale verso il basso maggiore di g in {histories_beyond} analisi su"
    " {histories} (accelerogramma"
    " {record} dal livello {level})",
    "scale_factors_large": "fattori di scala maggiori di {limit} in {histories_beyond} analisi su {histories},"
    " il massimo"
    " {largest} (accelerogramma {record} al livello {level})",
    "factors_off_levels": "fattori assegnati che scostano {factors_beyond} accelerogrammi su {factors} dal loro"
    " livello di più"
    " del {limit} %, il più lontano {record} con {im} = {value} al livello {level}",
    "no_collapse": _NO_CURVE
    + "nessun collasso ai livelli da {first_level} a {last_level}, rotazione massima {largest_edp}",
    "no_motion": _NO_CURVE + "nessun moto ai livelli da {first_level} a {last_level}, attivazione a {trigger_g} g",
    "all_collapse": _NO_CURVE + "collasso in tutte le analisi ai livelli da {first_level} a {last_level}",
    "single_level": _NO_CURVE + "un solo livello, {first_level}",
    "decreasing": _NO_CURVE + "i collassi non crescono con il livello",
    "not_converged": _NO_CURVE + "la stima non converge",
    "separated": _NO_CURVE + "nessuna sovrapposizione tra livelli con e senza collassi",
    "extrapolated": "mediana della curva di fragilità {theta}, fuori dai livelli da {first_level} a {last_level}",
    "nearly_flat": "pendenza della curva di fragilità non significativa: mediana {theta} e dispersione {beta}"
    " non affidabili",
    "curves_without_fit": "{curves} curve su {of_curves} senza stima",
    "curves_extrapolated": "{curves} curve su {of_curves} con mediana fuori dai livelli",
    "curves_nearly_flat": "{curves} curve su {of_curves} con pendenza non significativa",
    "population_without_fit": "curva dell'insieme delle pareti senza stima",
    "population_extrapolated": "mediana dell'insieme delle pareti {theta}, fuori dai livelli",
    "population_nearly_flat": "pendenza della curva dell'insieme delle pareti non significativa",
    "union_without_fit": "curva di {wall} senza stima",
    "union_extrapolated": "mediana di {wall} {theta}, fuori dai livelli",
    "union_nearly_flat": "mediana di {wall} {theta}: pendenza della curva non significativa",
    "ill_conditioned": "errore stimato della rotazione massima maggiore di {limit}, fino a {largest}, in"
    " {histories_beyond} analisi su {histories}",
    "collapse_in_doubt": "esito incerto, secondo l'errore stimato, in {histories_in_doubt} analisi su {histories}",
    "one_level": "un solo livello: nessuna curva di fragilità",
    "all_below_trigger": "nessuna analisi in cui la parete si muove",
    "one_record": "un solo accelerogramma",
    "hinge_not_weakest": "verifica non riferita alla cerniera più debole: il moltiplicatore è minimo,"
    " {weakest_alpha_0}, per la cerniera alla quota relativa {weakest_hinge}",
    "hinge_above_usual": "il moltiplicatore si riduce quanto più in alto è la cerniera, fino a {weakest_alpha_0} alla"
    " quota relativa {weakest_hinge}: una cerniera così alta è piuttosto un ribaltamento dal solaio inferiore",
    "diaphragm_not_in_demand": "il solaio deformabile in sommità muove la parete nelle analisi, ma non è nello spettro"
    " della norma: la domanda della verifica cinematica può essere troppo piccola",
    "anchor_before_bar": "gerarchia delle resistenze non rispettata: l'ancoraggio di {item} cede a {anchor_force_per_m}"
    " kN/m, prima dello snervamento della barra a {bar_force_per_m} kN/m, e di colpo; verifica lineare SLV con q > 1"
    " non applicabile",
    "plate_too_thin": "capochiave di {item} troppo sottile: {plate_thickness} m, ne servono {plate_needed}; la verifica"
    " ne suppone uniforme la pressione sulla muratura",
    "anchor_factor_differs": "ancoraggio di {item} non verificato con il fattore di confidenza della verifica: la sua"
    " muratura ha {anchor_knowledge}",
    "anchor_not_checked": "ancoraggio di {item} non verificato: non sono assegnati né il capochiave né la forza per cui"
    " cede",
    "period_beyond_spectrum": "il periodo equivalente raggiunge {period_s} s: oltre T_E, almeno {limit_s} s secondo il"
    " sottosuolo, gli spostamenti di NTC 2018, 3.2.3.2.3 si riducono, e la domanda della verifica no",
    "few_clusters": "solo {clusters} terremoti per {records} accelerogrammi",
}


def status(language: Language, name: str) -> str:
    """Status of a fit in words."""
    return STATUSES[name] if language.code == "en" else FITS[name]


def warning(language: Language, found: DondoloWarning) -> str:
    """A warning in words."""
    if language.code == "en":
        return str(found)
    if found.code not in WARNINGS:
        return f"avvertenza {found.code} (v. file dei risultati)"
    values = defaultdict(lambda: "\N{EN DASH}", found.subject)
    if "item" in found.subject:
        kind, _, place = found.subject["item"].partition(" ")
        values["item"] = f"{ITEMS.get(kind, kind)} {place}".strip()
    # Documents have forces in kN and kN/m, results in N and N/m.
    numbers = {name: 1e-3 * value if "_force" in name else value for name, value in found.numbers.items()}
    values |= {name: language.plain(number(value)) for name, value in numbers.items()}
    return WARNINGS[found.code].format_map(values)
