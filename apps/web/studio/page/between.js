// Shows what a stroke changes between two frames of the studio: a small canvas over the large one, as a browser
// composes all of a canvas anew that has changed.

/** Sides of the small canvas are multiples of it, in physical pixels, so that it seldom grows. */
const STEP = 64;

/** The part of the window that a stroke has changed since the last frame. */
export class Overlay {
  #canvas = document.createElement("canvas");
  #pen = this.#canvas.getContext("2d", { willReadFrequently: true });
  /** Left, top, right and bottom in physical pixels; null while nothing is shown. */
  #box = null;

  constructor() {
    this.#canvas.id = "between";
    this.#canvas.hidden = true;
    this.#canvas.ariaHidden = "true";
    document.body.append(this.#canvas);
  }

  /** A frame shows all. */
  clear() {
    if (this.#box === null) return;
    this.#box = null;
    this.#canvas.hidden = true;
  }

  /** Shows a part that has changed. */
  show({ left, top, width, height, pixels, lines, strokes, dot }) {
    if (width === 0 || height === 0) return;
    this.#cover(left, top, left + width, top + height);
    const pen = this.#pen;
    const [x, y] = this.#box;
    pen.putImageData(new ImageData(pixels, width, height), left - x, top - y);
    pen.save();
    pen.beginPath();
    pen.rect(left - x, top - y, width, height);
    pen.clip();
    pen.translate(-x, -y);
    pen.lineJoin = "round";
    for (const [width, color] of strokes) {
      pen.lineWidth = width;
      pen.strokeStyle = color;
      for (const [points, closed] of lines) {
        pen.beginPath();
        for (let at = 0; at < points.length; at += 2) pen.lineTo(points[at], points[at + 1]);
        if (closed) pen.closePath();
        pen.stroke();
      }
    }
    if (dot) {
      const [[atX, atY, dark, radius], color] = dot;
      const disc = (radius, fill) => {
        pen.beginPath();
        pen.arc(atX, atY, radius, 0, 2 * Math.PI);
        pen.fillStyle = fill;
        pen.fill();
      };
      disc(dark, strokes[0][1]);
      disc(radius, color);
      pen.lineWidth = strokes[1][0];
      pen.strokeStyle = strokes[1][1];
      pen.stroke();
    }
    pen.restore();
  }

  /** Makes the canvas reach over a rectangle, with what it shows already. */
  #cover(left, top, right, bottom) {
    const old = this.#box;
    const all = old === null ? [left, top, right, bottom]
      : [Math.min(old[0], left), Math.min(old[1], top), Math.max(old[2], right), Math.max(old[3], bottom)];
    const box = all.map((at, index) => STEP * (index < 2 ? Math.floor(at / STEP) : Math.ceil(at / STEP)));
    if (old !== null && box.every((at, index) => at === old[index])) return;
    const canvas = this.#canvas;
    const kept = old && this.#pen.getImageData(0, 0, canvas.width, canvas.height);
    canvas.width = box[2] - box[0];
    canvas.height = box[3] - box[1];
    if (kept) this.#pen.putImageData(kept, old[0] - box[0], old[1] - box[1]);
    const px = (count) => `${count / devicePixelRatio}px`;
    Object.assign(canvas.style, { left: px(box[0]), top: px(box[1]), width: px(canvas.width), height: px(canvas.height) });
    canvas.hidden = false;
    this.#box = box;
  }
}
