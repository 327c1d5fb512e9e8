"""Italian of the variables of a case by their names, and of notes by their codes; the English is in the library."""

from __future__ import annotations

#: Meaning of each variable of the groups of a case
MEANINGS = {
    "task": "tipo di analisi",
    "title": "testo libero",
    "output": "inizio dei nomi dei file dei risultati, rispetto alla cartella corrente",
    "histories": "scrittura della tabella di tutte le analisi",
    "spreadsheet_safe": "apostrofo davanti ai nomi che un foglio di calcolo prenderebbe per formule",
    "threads": "numero di thread; 0: tutti, o OMP_NUM_THREADS",
    "name": "nome nei risultati",
    "mechanism": "meccanismo di collasso",
    "height": "altezza della parete",
    "thickness": "spessore della parete",
    "density": "densità della muratura",
    "section_height": "altezze dei piani dal basso, al posto di height",
    "section_thickness": "loro spessori, al posto di thickness",
    "section_fill": "frazione di muratura di ogni piano, 1 se non assegnata",
    "section_offset": "arretramento della faccia esterna di ogni piano rispetto al più basso, 0 se non assegnato",
    "section_base_width": "larghezza di ogni prospetto alla base / larghezza a cui si riferiscono i valori al metro,"
    " 1 se non assegnata",
    "section_top_width": "la stessa in sommità, come alla base se non assegnata; 0 per un timpano",
    "leaves": "numero di paramenti uguali e non collegati: ciascuno oscilla da solo con la sua parte di spessore",
    "hinge_level": "quote delle cerniere: ognuna dà una parete, quella che le sta sopra",
    "hinge_at": "cerniera alla base di ogni piano, al posto di hinge_level",
    "mass": "massa del corpo, al posto della densità",
    "centroid_depth": "distanza del baricentro dalla faccia esterna, con mass",
    "centroid_height": "quota del baricentro, con mass",
    "hinge_inertia": "inerzia rispetto alla cerniera, con mass",
    "hinge_depth": "distanza della cerniera dalla faccia esterna; in flessione verticale, di ogni cerniera dalla sua"
    " faccia",
    "compressive_strength": "resistenza a compressione della muratura, da cui segue quella distanza",
    "stress_block": "tensione nella zona compressa della base / resistenza, 0,85 se non assegnata",
    "young_modulus": "modulo elastico della muratura di un elemento libero, ridotto per la fessurazione: un valore o un"
    " intervallo, per le verifiche",
    "free": "elemento libero, come un parapetto, che nessun muro ortogonale trattiene",
    "edge_radius": "raggio dello spigolo su cui la parete rotola, che è anche l'arretramento della cerniera a riposo",
    "load": "carichi verticali che accompagnano la parete, al metro di parete",
    "load_depth": "distanza di ogni carico dalla faccia esterna",
    "load_height": "quota di ogni carico sopra la base",
    "load_inertia": "quale massa di ogni carico si muove con la parete",
    "load_lifted": "frazione di ogni carico la cui massa è sollevata dalla parete, con load_pushed, al posto di"
    " load_inertia",
    "load_pushed": "frazione di ogni carico la cui massa è spinta dalla parete",
    "load_seat": "spostamento orizzontale per cui ogni carico perde l'appoggio",
    "load_total": "carichi verticali che accompagnano un cantonale, ciascuno intero e non al metro",
    "inertia_mass": "masse che la parete spinge ma non porta, al metro di parete",
    "inertia_depth": "distanza di ciascuna dalla faccia esterna",
    "inertia_height": "quota di ciascuna sopra la base",
    "thrust": "forze orizzontali verso l'esterno, al metro di parete",
    "thrust_depth": "distanza di ogni spinta dalla faccia esterna, la faccia interna se non assegnata",
    "thrust_height": "quota di ogni spinta sopra la base",
    "thrust_decay": "spostamento per cui ogni spinta si riduce a 1/e, costante se non assegnato",
    "thrust_total": "forze orizzontali verso l'esterno lungo la bisettrice di un cantonale, ciascuna intera e non al"
    " metro",
    "spring": "rigidezza delle molle che tirano e spingono, al metro di parete",
    "spring_depth": "distanza di ogni molla dalla faccia esterna",
    "spring_height": "quota di ogni molla sopra la base",
    "distributed_spring": "rigidezza delle molle distribuite su un'altezza, al metro di parete e di altezza",
    "distributed_spring_depth": "distanza di ogni letto di molle dalla faccia esterna",
    "distributed_spring_bottom": "quota a cui comincia ogni letto di molle",
    "distributed_spring_top": "quota a cui finisce ogni letto di molle",
    "tie_height": "quota dell'ancoraggio di ogni catena sopra la base",
    "tie_depth": "distanza di ogni ancoraggio dalla faccia esterna, 0 se non assegnata",
    "tie_area": "sezione di ogni catena al metro di parete: quella di una barra / interasse",
    "tie_bar": "diametro della barra di ogni catena, con tie_spacing, al posto di tie_area; di un cantonale senza"
    " interasse",
    "tie_spacing": "interasse delle barre di ogni catena lungo la parete",
    "tie_length": "lunghezza di ogni catena libera di allungarsi, di regola fino all'altro ancoraggio",
    "tie_modulus": "modulo elastico di ogni catena, 2,06e11 Pa se non assegnato",
    "tie_strength": "tensione di snervamento di ogni catena, 1,8e8 Pa se non assegnata",
    "tie_preload": "tensione di ogni catena a riposo, minore dello snervamento, 0 se non assegnata",
    "tie_strain": "deformazione per cui ogni catena o il suo ancoraggio si rompe, 0,02 se non assegnata",
    "tie_anchor_force": "forza al metro di parete per cui ogni ancoraggio cede di colpo; nessuna se non assegnata",
    "tie_anchor_total": "forza per cui l'ancoraggio di ogni catena di un cantonale cede di colpo, in tutto e non al"
    " metro; nessuna se non assegnata",
    "tie_plate_width": "larghezza del capochiave di ogni catena, da cui segue la forza dell'ancoraggio, al posto di"
    " tie_anchor_force",
    "tie_plate_height": "altezza del capochiave",
    "tie_plate_diameter": "diametro di un capochiave circolare, al posto di larghezza e altezza",
    "tie_plate_thickness": "spessore del capochiave, di acciaio come quello della barra",
    "tie_leaf": "spessore della muratura su cui appoggia il capochiave: un paramento, se i paramenti non sono"
    " collegati; altrimenti tutta la parete, del piano più sottile se due sono vicini",
    "tie_compression": "tensione verticale della muratura al capochiave, con masonry_friction; nessun attrito se non"
    " assegnata",
    "masonry_compression": "resistenza media a compressione della muratura ai capochiave; compressive_strength se non"
    " assegnata",
    "masonry_shear": "resistenza media a taglio in assenza di compressione ai capochiave",
    "masonry_tension": "resistenza media a trazione ai capochiave",
    "masonry_friction": "coefficiente d'attrito ai capochiave, con tie_compression",
    "masonry_knowledge_factor": "fattore di confidenza FC di queste resistenze, divise per 2 FC; 1,35 se non assegnato",
    "bearing_factor": "resistenza sotto il capochiave / resistenza della muratura, a giudizio del progettista; 1 se non"
    " assegnata",
    "interlock_overlap": "lunghezza di sovrapposizione tra le pietre della parete e quelle dei muri trasversali, il cui"
    " attrito la trattiene",
    "interlock_course": "altezza di un corso dell'ammorsamento",
    "interlock_thickness": "spessore di un muro trasversale",
    "interlock_spacing": "interasse dei muri trasversali",
    "interlock_friction": "coefficiente d'attrito dell'ammorsamento, 0,577 se non assegnato",
    "facade_length": "lunghezza della facciata, per la quale si dividono le masse dei cunei e di un prospetto",
    "wedge_thickness": "spessore di ogni muro trasversale di cui un cuneo ruota con la facciata",
    "wedge_angle": "angolo rispetto alla verticale della lesione sotto ogni cuneo; 0: nessun cuneo",
    "wedge_bottom": "quota sopra la base a cui ogni cuneo comincia, in un punto",
    "wedge_top": "quota a cui ogni cuneo finisce",
    "wedge_length": "lunghezza massima di ogni cuneo dietro la faccia interna, fino alla prima apertura del muro"
    " trasversale",
    "elevation_x": "posizioni lungo la facciata dei vertici del suo prospetto, nell'ordine, al posto di height",
    "elevation_z": "quote di questi vertici sopra la base",
    "opening_x": "posizione lungo la facciata a cui comincia ogni porta o finestra",
    "opening_z": "quota sopra la base a cui comincia ciascuna",
    "opening_width": "larghezza di ciascuna",
    "opening_height": "altezza di ciascuna",
    "axis_x": "posizioni lungo la facciata di due punti della retta attorno a cui ruota ciò che le sta sopra",
    "axis_z": "quote di questi due punti sopra la base",
    "half_gable": "il pannello è una delle due metà di un timpano che il colmo spinge fuori?",
    "load_x": "posizione di ogni carico lungo la facciata, con axis_x",
    "inertia_x": "posizione di ciascuna lungo la facciata, con axis_x",
    "thrust_x": "posizione di ogni spinta lungo la facciata, con axis_x",
    "wing_angle": "angolo rispetto alla verticale delle lesioni nei due muri di un cantonale; 0: nessuna ala",
    "wing_length": "lunghezza massima di ogni ala dietro la faccia interna dell'altro muro, fino alla prima apertura;"
    " nessuna se non assegnata",
    "hinge": "quota della cerniera intermedia / altezza della parete",
    "hinge_range": "quote minima e massima, in rapporto all'altezza, tra cui si cerca la cerniera più debole; 0,1 e 0,9"
    " se non assegnate",
    "elastic_period": "periodo delle piccole oscillazioni della striscia tra i vincoli, carico compreso, prima che i"
    " giunti si aprano; blocchi rigidi se non assegnato",
    "elastic_damping": "rapporto di smorzamento di tali oscillazioni, con elastic_period; 0,05 se non assegnato",
    "base_level": "quota della base rispetto al suolo, su un edificio non assegnato: la verifica non ha lo spettro a"
    " tale quota; hinge_level la assegna",
    "restitution": "modello degli urti",
    "restitution_value": "velocità dopo / prima di un urto, al posto di un modello",
    "restitution_factor": "fattore sul coefficiente di restituzione di qualunque modello",
    "restitution_sd": "scarto quadratico medio del coefficiente di restituzione, che varia allora da urto a urto,"
    " uniformemente attorno a quello del modello; solo con engine rk45",
    "restitution_seed": "seme dei numeri casuali di questi rapporti, 1 se non assegnato",
    "overburden": "carico verticale in sommità, al metro di parete",
    "overburden_inertia": "frazione di quel carico la cui massa è sollevata dalla parete",
    "eccentricity": "distanza di quel carico dalla mezzeria, verso la cerniera superiore attiva",
    "bearing": "dove appoggia quel carico, al posto dell'eccentricità",
    "bearing_distance": "distanza della risultante del carico dalla faccia interna o esterna",
    "table": "file CSV dei termini in funzione della rotazione, al posto delle liste",
    "rotation": "rotazioni q della tabella, da 0 a quella per cui il momento stabilizzante si annulla",
    "inertia": "inerzia J a ogni rotazione, al metro di parete",
    "lever": "somma delle masse per i loro bracci orizzontali L a ogni rotazione, al metro di parete",
    "moment": "momento stabilizzante G - Q a ogni rotazione, al metro di parete",
    "vertical_lever": "somma delle masse per i loro bracci verticali S a ogni rotazione, per il moto verticale",
    "travel": "spostamento d dell'oscillatore equivalente (C8.7.1.4) per ogni rotazione, per le verifiche",
    "weighted_lever": "somma dei pesi per i bracci orizzontali per ogni rotazione, per le verifiche; gravità per lever"
    " se non assegnata e nulla è portato",
    "weight": "peso di ogni corpo e carico, per le verifiche, al metro di parete",
    "displacement": "di quanto ciascuno si sposta verso l'esterno a riposo per una rotazione unitaria",
    "sides": "1: la parete oscilla da un solo lato; 2: da entrambi, e cambia lato a ogni urto",
    "top_share": "frazione k dell'accelerazione della sommità, relativa alla base, che muove la parete",
    "top_tilt": "inclinazione tau: fattore sullo spostamento della sommità relativo alla base",
    "bodies": "file CSV dei corpi rigidi",
    "joints": "file CSV delle cerniere e delle guide tra di essi",
    "actions": "file CSV di carichi, masse spinte e spinte in punti dei corpi",
    "ties": "file CSV delle catene, che trattengono i corpi verso l'esterno",
    "driver": "numero del corpo la cui rotazione è q",
    "gravity_share": "parte della gravità che agisce nel piano del moto",
    "body_table": "righe dei corpi come numeri, 11 per riga, al posto del loro file",
    "joint_table": "righe dei vincoli come numeri, 8 per riga, al posto del loro file",
    "action_table": "righe delle azioni come numeri, 10 per riga, al posto del loro file",
    "tie_table": "righe delle catene come numeri, 14 per riga, al posto del loro file",
    "period": "periodi dei modi dell'edificio su cui sta la parete",
    "damping": "loro smorzamenti, o uno per tutti; 0,05 se non assegnati",
    "participation": "loro coefficienti di partecipazione per la forma alla quota della parete, non in percentuale",
    "storeys": "numero n di piani, al posto di participation: 3 n / (2 n + 1) level / building_height",
    "level": "quota del piano della parete rispetto al suolo, con storeys",
    "building_height": "altezza dell'edificio, con storeys",
    "top_displacement": "spostamento d della sommità dell'edificio sotto i pesi applicati in orizzontale, al posto di"
    " period: 2 √d",
    "level_top": "quota rispetto al suolo fino a cui l'edificio muove la parete, con storeys; la sommità della parete o"
    " dell'edificio se non assegnata",
    "participation_top": "coefficienti di partecipazione per la forma alla sommità della parete, con participation; gli"
    " stessi se non assegnati",
    "diaphragm_period": "periodo del solaio deformabile che trattiene la sommità della parete; rigido se non assegnato",
    "diaphragm_damping": "suo smorzamento, 0,05 se non assegnato",
    "diaphragm_participation": "suo coefficiente di partecipazione per la forma alla parete, 1,27 se non assegnato",
    "refine": "parti in cui si divide un passo degli accelerogrammi; 0: quante ne richiede il periodo più breve",
    "catalogue": "tabella con una riga per accelerogramma, dalla cartella di questo file; colonne: file, dt_s, units,"
    " channel, format, vertical e altre",
    "polarity": "verso degli accelerogrammi",
    "vertical": "moto verticale: le componenti indicate dalla colonna vertical del catalogo",
    "vertical_factor": "fattore sulle componenti verticali rispetto al loro accelerogramma, 1 se non assegnato;"
    " negativo: positive verso il basso",
    "im": "misura d'intensità: anche 'sa(0.5)', 'saavg(0.2:2)' (periodi in s, livelli in g), 'pgv', 'arias',"
    " 'arias-trapz', 'cav', 'cav-trapz' (m/s), 'pgd', 'hi' (m), 'pga/a0', 'p*pgv/a0' (1)",
    "levels": "livelli crescenti della misura, nella sua unità",
    "first": "primo di livelli equidistanti, con last e count, al posto di levels",
    "last": "ultimo dei livelli equidistanti",
    "count": "numero dei livelli equidistanti, estremi compresi",
    "edp_thresholds": "stati di danno prima del collasso, rotazione / capacità",
    "states": "curve degli stati di danno: ognuna per sé, o con una sola dispersione, così che non si incrocino",
    "engine": "solutore; 'auto' sceglie quello adatto all'analisi",
    "rtol": "errore relativo di un passo",
    "atol": "errore assoluto di un passo, 1 = capacità",
    "edp_limit": "rotazione / rotazione di capacità che vale come collasso",
    "estimate_error": "stima dell'errore di ogni rotazione massima; circa tre volte il tempo",
    "certify": "stima degli errori, e ripetizione in 33 cifre di ogni analisi che lasciano dubbia",
    "gravity": "accelerazione di gravità",
    "code": "norma: NTC 2018 con la Circolare 7/2019",
    "ag": "accelerazione di picco su suolo rigido e orizzontale: una per tutti gli stati limite, o quelle di SLD, SLV e"
    " SLC",
    "f0": "massima amplificazione dello spettro su tale suolo, una o tre",
    "tc_star": "periodo d'inizio del tratto a velocità costante su tale suolo, uno o tre",
    "latitude": "latitudine del sito (WGS84): con longitude e nominal_life dà ag, f0 e tc_star di tutti gli stati"
    " limite",
    "longitude": "longitudine del sito (WGS84)",
    "nominal_life": "vita nominale V_N, con latitude e longitude; V_R = C_U V_N",
    "use_class": "classe d'uso, con il suo coefficiente C_U",
    "soil": "categoria di sottosuolo",
    "topography": "categoria topografica",
    "knowledge_factor": "fattore di confidenza FC: 1, 1,2 o 1,35; per una parete senza compressive_strength la verifica"
    " assume l'ultimo",
    "behaviour": "fattore di comportamento q della verifica lineare",
    "ultimate_state": "stato limite ultimo su cui si fonda il giudizio (NTC 8.3)",
    "friction": "coefficiente d'attrito alle cerniere: la verifica segnala una parete che scorre prima di ruotare",
    "building_period": "periodo del primo modo dell'edificio su cui sta la parete, uno per tutti gli stati limite o"
    " quelli di SLD, SLV e SLC; se non assegnato SLV e SLC assumono il peggiore tra 1 e 2 volte quello di &building",
    "building_damping": "rapporto di smorzamento dei modi dell'edificio, uno o tre, con building_period; se non"
    " assegnato quello di &building",
    "reference_life": "periodo di riferimento V_R, per i periodi di ritorno, con exceedance",
    "exceedance": "probabilità di superamento in quel periodo di SLD, SLV e SLC, i cui periodi di ritorno hanno ag, f0"
    " e tc_star",
}

#: Notes on the supports that move walls, by their codes in the library; {walls} are the walls that a note is about
SUPPORTS = {
    "records_at_base": "gli accelerogrammi sono applicati alla base della parete; quelli del suolo sottostimano la"
    " domanda su parapetti, timpani, pinnacoli, piani superiori e facciate appoggiate a un edificio",
    "buildings_move_walls": "gli accelerogrammi sono moti del suolo; edifici lineari muovono le pareti, alla base e"
    " in ciò a cui si appoggiano",
    "building_moves_both": "gli accelerogrammi sono moti del suolo; un edificio lineare muove i due appoggi della"
    " parete",
    "building_moves_base": "gli accelerogrammi sono moti del suolo; un edificio lineare muove la base della parete",
    "one_floor_moves_both": "i due estremi {walls} si muovono con un solo solaio; assegnare participation_top se la"
    " sommità si muove diversamente",
    "ties_to_building": "le catene {walls} sono ancorate all'edificio, e si muovono con esso",
    "ties_to_base": "le catene {walls} sono ancorate a ciò su cui poggia la base",
    "corner_one_direction": "tutti i modi dell'edificio {walls} agiscono lungo la bisettrice del cantonale; modi delle"
    " due direzioni ne muoverebbero ciascuno una componente",
}


def property_name(english: str) -> str:
    """A property of a wall, named in English with blanks, in Italian; what is none is left as it is."""
    from dondolo.reporting.headings import COLUMNS

    name = english.replace(" ", "_")
    return COLUMNS.get(name, MEANINGS[name]) if name in MEANINGS else english
