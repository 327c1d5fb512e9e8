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
    "latitude": "latitudine del sito, WGS84",
    "longitude": "longitudine del sito, WGS84",
    "latitude_ed50": "latitudine in ED50, il sistema del reticolo di pericolosità",
    "longitude_ed50": "longitudine in ED50, il sistema del reticolo di pericolosità",
    "distance": "distanza di un nodo del reticolo di pericolosità",
    "nominal_life": "vita nominale",
    "use_coefficient": "coefficiente d'uso",
    "ag": "accelerazione di picco su suolo rigido e orizzontale",
    "f0": "massima amplificazione su tale suolo",
    "tc_star": "periodo d'inizio del tratto a velocità costante su tale suolo",
    "stratigraphy": "coefficiente di sottosuolo",
    "topography": "coefficiente topografico",
    "tb": "periodo d'inizio del tratto ad accelerazione costante nel sito",
    "td": "periodo d'inizio del tratto a spostamento costante nel sito",
    "eta": "fattore di smorzamento",
    "reference_life": "periodo di riferimento",
    "return_period_asked": "periodo di ritorno da V_R e P_VR, oltre quelli del reticolo",
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
    "applicable": "verifica applicabile: 0 no, rottura fragile dell'ancoraggio, elemento libero senza E o spettro non"
    " assegnato",
    "soil_factor": "coefficiente di sottosuolo e topografico, prodotto di S_S e S_T",
    "tc": "periodo d'inizio del tratto a velocità costante nel sito",
    "pga": "accelerazione di picco nel sito",
    "floor_pga": "accelerazione di picco del suolo, o alla quota z di una parete su un edificio",
    "modal_pga": "accelerazione di picco dai soli modi dell'edificio, minore di quella del suolo",
    "modal_demand": "accelerazione spettrale dai soli modi dell'edificio, minore di quella del suolo",
    "knowledge_factor": "fattore di confidenza",
    "knowledge_given": "fattore di confidenza assegnato, minore di quello che la norma chiede",
    "behaviour": "fattore di comportamento",
    "free_element": "elemento libero, che nulla trattiene sopra la base: 1 sì, 0 forse",
    "young_modulus": "modulo elastico della muratura dell'elemento libero, valore assunto dal progettista, il maggiore"
    " se è un intervallo",
    "least_modulus": "modulo elastico minore dell'intervallo, valore assunto dal progettista",
    "t0": "periodo elastico dell'elemento libero prima del dondolio",
    "shortest_t0": "periodo elastico minimo",
    "longest_t0": "periodo elastico massimo",
    "governing_t0": "periodo tra questi per cui la domanda è massima",
    "floor_t0": "accelerazione spettrale per tale periodo, del suolo o alla quota z",
    "yield_displacement": "spostamento in cui il ramo elastico incontra la capacità",
    "yield_acceleration": "accelerazione spettrale in tale punto",
    "elastic_period": "periodo della striscia prima che i giunti si aprano",
    "elastic_damping": "rapporto di smorzamento prima che i giunti si aprano",
    "opening_acceleration": "accelerazione spettrale per cui i giunti si aprono",
    "opening_demand": "accelerazione spettrale per tale periodo, del suolo o alla quota z",
    "opening_ratio": "rapporto capacità/domanda dell'apertura dei giunti, un'ulteriore informazione",
    "alpha_0": "moltiplicatore di attivazione del meccanismo",
    "bare_alpha_0": "lo stesso senza cunei dei muri trasversali, o senza ali",
    "mass": "massa partecipante",
    "mass_ratio": "frazione di massa partecipante",
    "a_0": "accelerazione spettrale di attivazione",
    "d_0": "spostamento per cui il moltiplicatore si annulla",
    "halves_overlap": "sovrapposizione delle due metà di un timpano per tale spostamento, in cui si incastrano",
    "hinge": "quota relativa della cerniera",
    "lowest_hinge": "quota relativa più bassa tra cui si cerca la cerniera più debole",
    "highest_hinge": "quota relativa più alta tra cui si cerca la cerniera più debole",
    "upper_moment": "momento di pesi, spinte e catene del blocco superiore rispetto alla cerniera intermedia",
    "floor_top": "forza orizzontale del solaio superiore all'attivazione, per metro",
    "floor_base": "forza orizzontale del solaio inferiore all'attivazione, per metro",
    "friction_needed": "attrito necessario alla cerniera all'attivazione, |H|/V",
    "friction": "attrito assegnato alle cerniere",
    "sliding_alpha": "moltiplicatore per cui la cerniera scorre, con l'attrito assegnato",
    "turns_first": "la cerniera ruota prima di scorrere: 1 sì, 0 no",
    "required": "il giudizio sulla parete si fonda su questa verifica: 1 sì, 0 è un'ulteriore informazione",
    "least_zeta": "indice di sicurezza minimo tra tutte le cerniere",
    "least_zeta_hinge": "quota relativa della cerniera per cui è minimo",
    "tied_zeta": "indice di sicurezza con tutte le catene fino alla rottura",
    "less_zeta": "massimo indice di sicurezza senza contare alcune catene, o tutte",
    "less_sld": "rapporto capacità/domanda dello SLD senza contarle",
    "less_hinge": "quota relativa della cerniera più debole senza di esse",
    "linear_zeta_e": "indice di sicurezza della verifica lineare",
    "weakest_hinge": "quota relativa della cerniera per cui il moltiplicatore di attivazione è minimo",
    "weakest_alpha_0": "moltiplicatore per tale cerniera",
    "level": "quota rispetto al suolo dello spettro di domanda",
    "wall_top": "quota della sommità della parete, come altezza dell'edificio",
    "proposed_period": "prima approssimazione del periodo dell'edificio",
    "given_period": "periodo del primo modo dell'edificio assegnato per lo stato limite",
    "given_damping": "rapporto di smorzamento dell'edificio assegnato per lo stato limite",
    "building_period": "periodo del primo modo dell'edificio assunto nella domanda",
    "building_damping": "rapporto di smorzamento di tale modo",
    "building_zeta": "indice di sicurezza con altri periodo e smorzamento dell'edificio",
    "diaphragm_period": "periodo del solaio deformabile in sommità, non compreso nella domanda",
    "tie_fracture": "spostamento per cui si rompono le catene che danno più di metà della resistenza",
    "capacity_ag": "capacità in termini di accelerazione su suolo rigido",
    "capacity_pga": "capacità in termini di accelerazione di picco nel sito",
    "displacement": "capacità di spostamento",
    "acceleration": "accelerazione spettrale di capacità per tale spostamento",
    "period": "periodo secante",
    "damping": "smorzamento equivalente",
    "spectral_demand": "accelerazione spettrale del suolo, o alla quota z di una parete su un edificio",
    "demand": "domanda di spostamento",
    "ratio": "rapporto capacità/domanda",
    "records": "accelerogrammi",
    "histories": "analisi dinamiche con l'accelerazione di picco del sito",
    "beyond": "di esse oltre lo spostamento di collasso (nessuna è ammessa)",
    "mean_displacement": "media degli spostamenti massimi",
    "untied_displacement": "spostamento che sarebbe ammesso senza contare le catene",
    "verified": "esito",
    "probability": "probabilità di collasso con la curva di fragilità",
    "probability_low": "estremo inferiore del suo intervallo di confidenza al 95 %",
    "probability_high": "estremo superiore del suo intervallo di confidenza al 95 %",
}

# Items of the calculation
ITEMS = {
    "section": "tratto",
    "masonry": "muratura, corpo rigido unico",
    "wedge": "cuneo",
    "corner": "spigolo",
    "wing": "ala",
    "load": "carico",
    "mass": "massa trattenuta",
    "thrust": "spinta",
    "tie": "catena",
    "body": "corpo",
    "moment": "momento",
    "ties": "catene",
    "T_1": "T_1",
    "1.5 T_1": "1,5 T_1",
    "2 T_1": "2 T_1",
    "2 T_1, 10 %": "2 T_1, 10 %",
    "friction": "attrito",
    "node": "nodo",
    "lower block": "blocco inferiore",
    "upper block": "blocco superiore",
    "load on top": "carico in sommità",
    "base hinge": "cerniera alla base",
    "middle hinge": "cerniera intermedia",
    "top hinge": "cerniera in sommità",
}

MECHANISMS = {
    "one_sided": "ribaltamento semplice verso l'esterno",
    "free_standing": "parete libera, oscillazione sui due lati",
    "two_block": "flessione verticale",
    "corner": "ribaltamento del cantonale",
    "tabulated": "cinematismo tabellato",
    "chain": "catena cinematica di corpi rigidi",
}

_NO_CURVE = "nessuna curva di fragilità per la parete {wall}: "
# Code of the warning of strips that bend before they open, of which no check of rigid blocks makes a green verdict
BENDING = "bending_neglected"

# Warnings by their codes, with their subjects and numbers
WARNINGS = {
    "value_below_usual": "il valore {value} di {variable} è minore di {limit}: unità di misura da controllare",
    "value_above_usual": "il valore {value} di {variable} è maggiore di {limit}: unità di misura da controllare",
    "height_below_thickness": "parete {wall}: altezza minore dello spessore, dati forse scambiati",
    "load_place_without_load": "parete {wall}: posizione di un carico sovrastante nullo",
    "overlap_above_thickness": "parete {wall}: ammorsamento maggiore dello spessore della parete ortogonale",
    "mass_beside_size": "parete {wall}: la massa divisa per altezza e spessore è {density} kg/m³, limite usuale"
    " {limit}: unità di misura da controllare",
    "restitution_of_solid": "parete {wall}: il coefficiente di restituzione è quello di un blocco pieno, benché la"
    " frazione di muratura cambi tra i tratti; quello dell'urto con le masse al loro posto è {impulse}",
    "levels_above_usual": "livelli fino a {largest} di {im}, oltre il limite usuale {limit}: unità di misura da"
    " controllare",
    "record_without_motion": "accelerogramma {record}: accelerazione di picco nulla",
    "probabilities_sum_to_one": "parete {wall}: le probabilità dei suoi meccanismi hanno somma 1, ma sono indipendenti:"
    " da controllare se i meccanismi si escludono a vicenda (occurrence = 'exclusive')",
    "records_without_event": "terremoto non indicato per {records_beyond} accelerogrammi su {records}: gli"
    " errori standard li"
    " considerano indipendenti",
    "records_unread_date": "accelerogramma {record}: data non confrontabile con quelle degli altri accelerogrammi dello"
    " stesso evento, considerato un solo terremoto ({records_beyond} su {records})",
    "record_pga": "accelerogramma {record}: accelerazione di picco {pga_g} g fuori dal campo usuale (limite"
    " {limit_g} g)",
    "record_start": "accelerogramma {record}: la prima accelerazione è {share} volte quella di picco (limite {limit}):"
    " da controllare se la registrazione è tagliata",
    "record_vertical": "accelerogramma {record}: componente verticale, che muove la parete come se fosse orizzontale"
    " ({records_beyond} su {records})",
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
    "hinge_not_weakest": "verifica riferita alla cerniera più debole, alla quota relativa {weakest_hinge}, per cui il"
    " moltiplicatore è {weakest_alpha_0}; per la cerniera assegnata, {hinge}, è {alpha_0}: le analisi dinamiche e la"
    " probabilità di collasso si riferiscono a questa",
    "hinge_below_usual": "il moltiplicatore cresce quanto più in alto è la cerniera, da {weakest_alpha_0} alla quota"
    " relativa {weakest_hinge}, la più bassa considerata: una cerniera più bassa sarebbe più debole",
    "least_elsewhere": "l'indice di sicurezza non è minimo per la cerniera più debole, dove è {zeta_e}: alla quota"
    " relativa {least_zeta_hinge} è {least_zeta}, ma lì il meccanismo si attiva per un'accelerazione maggiore",
    "top_without_load": "nessun carico preme sulla sommità della parete: il solaio la deve trattenere con ancoraggi,"
    " per {floor_top_n_m} N al metro all'attivazione del meccanismo",
    "hinge_above_usual": "il moltiplicatore si riduce quanto più in alto è la cerniera, fino a {weakest_alpha_0} alla"
    " quota relativa {weakest_hinge}: una cerniera così alta è piuttosto un ribaltamento dal solaio inferiore",
    BENDING: "parete {wall}: la flessione che precede l'apertura dei giunti è trascurata; pareti tra due"
    " solai come questa si aprono a circa metà dell'accelerazione di attivazione, e le mediane sono minori del 6-22 %"
    " con un periodo di 0,10 s e del 7-37 % con 0,15 s (forza sovrastante senza massa); per questa parete circa"
    " {lower_010} % e {lower_015} %, con 4 in più o in meno",
    "opening_above_usual": "parete {wall}: i giunti si aprono a {opening_edp} della capacità, oltre {limit}: la parete"
    " si inflette più che oscillare, periodo elastico forse troppo lungo",
    "lifted_while_closed": "parete {wall}: la massa sovrastante non è sollevata finché i giunti sono chiusi, ma conta"
    " anche allora; mediane da 3 % troppo basse a 6 % troppo alte",
    "mirror_image": "parete {wall}: si assume che verso l'interno si muova come la sua immagine speculare, ma le"
    " tabelle non mostrano che muratura e carichi siano simmetrici: aggiungere come corpo 0 ciò che resta fermo, o due"
    " pareti di una facciata",
    "bodies_meet": "parete {wall}: i corpi {body} e {other} si compenetrano di {depth_mm} mm per una rotazione di"
    " {rotation_rad} rad: il giunto si apre forse altrove",
    "restitution_above_bound": "parete {wall}: il coefficiente di restituzione {restitution} supera {limit}, quello di"
    " un urto su tutti i giunti con attrito illimitato",
    "floor_without_period": "parete {wall}: i solai di un edificio con un solo modo, di "
    "{building_period_s} s, non hanno"
    " moto vicino al periodo elastico della parete: assegnare anche il secondo modo, di circa {second_period_s} s",
    "record_coarse": "accelerogramma {record}: il passo di {dt_s} s è maggiore di un sesto del periodo elastico"
    " {elastic_period_s} s della parete {wall}, e il moto con tale periodo manca ({records_beyond} su {records})",
    "threshold_while_closed": "parete {wall}: lo stato di danno di EDP {edp_threshold} è raggiunto con i giunti chiusi,"
    " che si aprono a {opening_edp}",
    "serviceability": "classe d'uso IV: il giudizio si fonda anche sullo SLD (NTC 8.3, che ne ammette livelli ridotti);"
    " per lo SLO non c'è una formula per i meccanismi locali",
    "halves_jam": "le due metà del timpano attraversano il piano del suo asse, e per d_0* si sovrapporrebbero di"
    " {overlap_m} m: si incastrano, per cui il moltiplicatore è a favore di sicurezza, e gli spostamenti con ciò che ne"
    " segue non sono provati",
    "slides_first": "{item}: scorre prima di ruotare, perché con un attrito {friction} non ha quello necessario"
    " all'attivazione, {friction_needed}, per il moltiplicatore {alpha_0}",
    "sliding_unknown": "le forze alle cerniere di una tabella, di una catena cinematica o di un asse inclinato non"
    " sono note: non si verifica se scorrono prima di ruotare",
    "friction_not_given": "{item}: per ruotare e non scorrere serve all'attivazione un attrito {friction_needed}; non"
    " si verifica se c'è, perché l'attrito non è assegnato",
    "perhaps_free": "la parete comincia sopra il suolo o finisce sopra l'edificio, e non la trattengono né catene né"
    " ammorsamenti: se è un elemento libero, come un parapetto o la parte superiore di una facciata, va indicato"
    " (C8.7.1.2.1.3)",
    "modulus_missing": "manca E: per un elemento libero la Circolare chiede S_eZ(T_0) (C8.7.1.2.1.5), e le verifiche"
    " lineari di SLD e SLV non sono applicabili; quelle non lineari contano i soli spostamenti",
    "free_behaviour": "fattore di comportamento della verifica lineare SLV {behaviour}: per i parapetti la Tabella"
    " C7.2.I ha q_a = 1",
    "period_between": "il periodo elastico dell'elemento libero è tra {shortest_s} e {longest_s} s, per l'intervallo"
    " del modulo elastico o per quanto la [C8.7.1.7] non considera (tratti diversi, masse, catene, molle); la domanda è"
    " la massima tra questi",
    "knowledge_raised": "fattore di confidenza della verifica {knowledge_factor}, quello del livello LC1, al posto di"
    " {knowledge_given}: la resistenza a compressione non è assegnata, e il moltiplicatore non ne tiene conto"
    " (C8.7.1.2.1.3)",
    "ground_governs": "alla quota della parete i modi dell'edificio danno {quantity} = {modal_g} g, meno di"
    " {ground_g} g del suolo, che governa: per a_Z si assume almeno a_g S e per S_eZ almeno S_e(T) a ogni periodo, per"
    " analogia con la [C7.2.11] (scelta di dondolo; la [C7.2.5] lo dice solo per T > T_1)",
    "diaphragm_not_in_demand": "il solaio deformabile in sommità muove la parete nelle analisi, ma non è nello spettro"
    " della norma: la domanda della verifica cinematica può essere troppo piccola",
    "anchor_before_bar": "gerarchia delle resistenze non rispettata: l'ancoraggio di {item} cede a {anchor_force_per_m}"
    " kN{per}, prima dello snervamento della barra a {bar_force_per_m} kN{per}, e di colpo; verifica lineare SLV con"
    " q > 1 non applicabile",
    "plate_too_thin": "capochiave di {item} troppo sottile: {plate_thickness} m, ne servono {plate_needed}; la verifica"
    " ne suppone uniforme la pressione sulla muratura",
    "anchor_factor_differs": "ancoraggio di {item} non verificato con il fattore di confidenza della verifica: la sua"
    " muratura ha {anchor_knowledge}",
    "anchor_not_checked": "ancoraggio di {item} non verificato: non sono assegnati né il capochiave né la forza per cui"
    " cede",
    "period_beyond_spectrum": "il periodo equivalente raggiunge {period_s} s: oltre T_E, almeno {limit_s} s secondo il"
    " sottosuolo, gli spostamenti di NTC 2018, 3.2.3.2.3 si riducono, e la domanda della verifica no",
    "return_period_held": "periodo di ritorno dello {limit_state}, {return_period_year} anni, oltre quelli del reticolo"
    " di pericolosità: la pericolosità è quella di {held_year} anni",
    "floor_not_given": "la base della parete è a {level_m} m dal suolo e l'edificio su cui sta non è assegnato: manca"
    " lo spettro a tale quota (C8.7.1.2.1.5, C8.7.1.2.1.8), e la verifica dà alpha_0, a_0* e d_0* ma nessun rapporto;"
    " aggiungere &building period = {building_period_s}, building_height = {building_height_m}, storeys = {storeys},"
    " level = {level_m} con i valori dell'edificio (qui H è la sommità della parete e il periodo 0,05 H^0,75,"
    " C7.3.3.2)",
    "ties_left_out": "ζ_E dello SLV con le catene fino alla rottura: {tied_zeta} (C8.7.1.2.1.6, secondo trattino);"
    " senza contare {the_item}: {less_zeta}; si assume {less_zeta}: con {the_item} lo SLV non aumenta, e il rapporto"
    " all'attivazione (SLD) passa da {less_sld} a {tied_sld}",
    "ties_counted": "ζ_E dello SLV con le catene fino alla rottura: {tied_zeta} (C8.7.1.2.1.6, secondo trattino); senza"
    " contare {the_item}: {less_zeta}; si assume {tied_zeta}",
    "building_softened": "allo {limit_state} il periodo dell'edificio è assunto {building_period_s} s e lo smorzamento"
    " {building_damping}, per cui ζ_E è minimo tra T_1 e 2 T_1 (C8.7.1.2.1.4): {zeta_e}, con l'edificio come assegnato"
    " {zeta_given}; building_period e building_damping assegnano invece i valori di un'analisi pushover",
    "few_clusters": "solo {clusters} terremoti per {records} accelerogrammi",
}


def status(language: Language, name: str) -> str:
    """Status of a fit in words."""
    return STATUSES[name] if language.code == "en" else FITS[name]


def item_in_words(name: str) -> str:
    """An item of a calculation, such as 'load 1', in Italian."""
    kind, _, place = name.partition(" ")
    return ITEMS.get(name) or (f"{ITEMS[kind]} {place}" if kind in ITEMS else name)


def with_article(item: str) -> str:
    """An item in Italian words with its article, 'la catena 1', 'le catene 1, 3'."""
    return f"{'le' if item.startswith('catene') else 'la'} {item}"


def warning(language: Language, found: DondoloWarning) -> str:
    """A warning in words."""
    if language.code == "en":
        return str(found)
    if found.code not in WARNINGS:
        return f"avvertenza {found.code} (v. file dei risultati)"
    values = defaultdict(lambda: "\N{EN DASH}", found.subject)
    values["per"] = "" if found.subject.get("of") == "whole" else "/m"
    if "item" in found.subject:
        values["item"] = item_in_words(found.subject["item"])
        values["the_item"] = with_article(values["item"])
    # Documents have forces in kN and kN/m, results in N and N/m.
    numbers = {name: 1e-3 * value if "_force" in name else value for name, value in found.numbers.items()}
    values |= {name: language.plain(number(value)) for name, value in numbers.items()}
    return WARNINGS[found.code].format_map(values)
