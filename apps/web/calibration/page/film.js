// A film on two cards: contrast ratio, hiding power, and curves of K and S.

import { chart } from "./chart.js";
import { form } from "./forms.js";
import { $, download, element, namedTable, remarkList, showResult } from "./page.js";
import { long, viewing, work } from "./shelf.js";
import { say } from "./tabs.js";

let found = null;

// `settled` waits until the files are read.
export function startFilm(settled) {
  const boxes = [["film-fields", ["thickness_mm", "solids"]], ["film-options", null]];
  const options = form("film", "FilmRequest", boxes, ["viewing"]);
  $("film-start").addEventListener("click", async () => {
    await settled();
    if (!$("film-start").disabled) compute(options);
  });
  for (const id of ["film-which", "film-curves"]) $(id).addEventListener("change", showCurves);
  $("film-csv").addEventListener("click", () => download("film.csv", found.csv, "text/csv"));
}

async function compute(options) {
  const done = await work("computing", async () => {
    const request = { ...await options(), viewing: viewing() };
    // Without a surface there is no specular reflection to exclude.
    if (request.surface === "none") delete request.specular;
    return long.call("film", [JSON.stringify(request)]);
  });
  if (!done) return;
  found = done;
  show();
  say(`${found.films.length} ${found.films.length === 1 ? "film" : "films"} computed`);
}

const text = ({ value, deviation }, digits) => `${value.toFixed(digits)} +- ${deviation.toFixed(digits)}`;

function hides(hiding) {
  if (!hiding) return "at no thickness";
  return hiding.thickness_mm ? `${text(hiding.thickness_mm, 4)} mm` : `${text(hiding.factor, 3)} times this thickness`;
}

const nameOf = (film) => (film.thickness_mm === null ? film.sample : `${film.sample}, ${film.thickness_mm} mm`);

function show() {
  const { films, interpolated, contrast, illuminant, observer, remarks } = found;
  const heads = ["Film", "Contrast ratio", "Y over white", "Y over black", `Hides (${contrast}) at`, "Spreading rate"];
  const rows = films.map((film) => [
    nameOf(film), text(film.contrast_ratio, 4), ...film.luminances.map((y) => y.toFixed(2)), hides(film.hiding),
    film.hiding?.spreading_rate ? `${text(film.hiding.spreading_rate, 2)} m2/l` : "needs the thickness",
  ]);
  $("film-table").replaceChildren(namedTable(heads, rows));
  const between = interpolated.map(({ sample, spreading_rate: rate }) => `${sample}: contrast ratio ${contrast} at ${rate.toFixed(2)} m2/l, between its films.`);
  const about = `Y and contrast ratio under ${illuminant}, observer ${observer}; +- is one standard deviation.`;
  $("film-notes").replaceChildren(...[...between, about].map((line) => element("p", {}, line)), ...remarkList(remarks));
  $("film-which").replaceChildren(...films.map((film, place) => element("option", { value: place }, nameOf(film))));
  showResult("film");
  showCurves();
}

function showCurves() {
  const film = found.films[Number($("film-which").value)];
  $("film-curves").options[1].disabled = film.thickness_mm === null;
  if (film.thickness_mm === null) $("film-curves").value = "d";
  const kind = $("film-curves").value;
  const [end, unit] = kind === "d" ? [" d", "K d and S d"] : ["", "K and S per mm"];
  const column = (name) => film.powers.map((power) => power[name]);
  const curve = (letter, color, dash) => ({
    name: `${letter}${end}`, values: column(`${letter.toLowerCase()}_${kind}`), sd: column(`${letter.toLowerCase()}_${kind}_sd`), color, dash,
  });
  const series = [curve("K", "var(--k)"), curve("S", "var(--s)", "7 4")];
  const drawn = chart({ title: `${unit} of ${nameOf(film)}`, unit, nm: column("nm"), series, logarithmic: true });
  $("film-chart").replaceChildren(drawn);
}
