// A photograph whose pixels are target colours.

import { $, inkOn } from "./page.js";

// Pixels of a side that are shown at most; larger pictures are made smaller when they are decoded.
const MOST = 2048;

let point = { x: 0, y: 0 };
let picture = null;
let taken = () => {};

// Shows the photograph in `file`. `take` hears the code of each colour that is chosen.
export async function openPhotograph(file, take) {
  picture?.close();
  try {
    picture = await createImageBitmap(file);
  } catch {
    picture = null;
    throw { message: `${file.name} is not a picture that this browser reads`, hint: "choose a JPEG, PNG or WebP" };
  }
  const scale = Math.min(1, MOST / Math.max(picture.width, picture.height));
  const canvas = $("photo");
  canvas.width = Math.max(1, Math.round(picture.width * scale));
  canvas.height = Math.max(1, Math.round(picture.height * scale));
  taken = take;
  $("photograph").hidden = false;
  point = { x: canvas.width >> 1, y: canvas.height >> 1 };
  draw();
  choose();
}

export function startPhotograph() {
  const canvas = $("photo");
  canvas.addEventListener("click", (event) => {
    const box = canvas.getBoundingClientRect();
    move(((event.clientX - box.left) / box.width) * canvas.width, ((event.clientY - box.top) / box.height) * canvas.height);
    choose();
  });
  canvas.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 20 : 2;
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
    if (by) move(point.x + by[0], point.y + by[1]);
    else if (event.key === "Enter" || event.key === " ") choose();
    else return;
    event.preventDefault();
  });
  $("photo-size").addEventListener("change", choose);
}

const context = () => $("photo").getContext("2d", { willReadFrequently: true, colorSpace: "srgb" });

function move(x, y) {
  const { width, height } = $("photo");
  point = { x: Math.min(Math.max(Math.floor(x), 0), width - 1), y: Math.min(Math.max(Math.floor(y), 0), height - 1) };
  draw();
}

function square() {
  const side = Number($("photo-size").value);
  const { width, height } = $("photo");
  const [left, top] = [Math.max(point.x - (side >> 1), 0), Math.max(point.y - (side >> 1), 0)];
  return [left, top, Math.min(side, width - left), Math.min(side, height - top)];
}

function draw() {
  const { width, height } = $("photo");
  const area = context();
  area.drawImage(picture, 0, 0, width, height);
  const [left, top, wide, high] = square();
  for (const [grow, ink] of [[3, "#000"], [2, "#fff"]]) {
    area.strokeStyle = ink;
    area.strokeRect(left - grow - 0.5, top - grow - 0.5, wide + 2 * grow + 1, high + 2 * grow + 1);
  }
}

const linear = (byte) => (byte <= 10.31475 ? byte / 255 / 12.92 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
const encoded = (value) => Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));

// Takes the mean colour of the square around the point, of linear light.
function choose() {
  if (!picture) return;
  draw();
  const [left, top, wide, high] = square();
  const { data } = context().getImageData(left, top, wide, high);
  const sum = [0, 0, 0];
  for (let at = 0; at < data.length; at += 4) for (const channel of [0, 1, 2]) sum[channel] += linear(data[at + channel]);
  const code = `#${sum.map((value) => encoded(value / (wide * high)).toString(16).padStart(2, "0")).join("")}`;
  const told = $("photo-told");
  told.textContent = `${code} at ${point.x}, ${point.y}`;
  told.style.cssText = `background:${code};color:${inkOn(code)};padding:2px 8px;border-radius:4px`;
  taken(code);
}
