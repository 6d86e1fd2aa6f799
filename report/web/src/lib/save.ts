// Charts as SVG and PNG, tables as CSV, as the reader sees them.

const STYLES = ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray", "opacity", "font-size",
                "font-family", "font-weight", "font-variant-numeric", "text-anchor", "paint-order", "stroke-linejoin"];

function download(name: string, blob: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/// The chart on its own: colours of the page's theme written out, tips and handles left away.
export function svgText(svg: SVGSVGElement): string {
  const copy = svg.cloneNode(true) as SVGSVGElement;
  const [from, to] = [svg, copy].map((root) => [root, ...root.querySelectorAll<SVGElement>("*")]);
  from.forEach((element, i) => {
    const computed = getComputedStyle(element);
    for (const name of STYLES) (to[i] as SVGElement).style.setProperty(name, computed.getPropertyValue(name));
  });
  copy.querySelectorAll(".tip, .overlay, style").forEach((element) => element.remove());
  const box = svg.viewBox.baseVal;
  const paper = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  for (const [name, value] of Object.entries({width: box.width, height: box.height})) paper.setAttribute(name, String(value));
  paper.style.fill = getComputedStyle(document.documentElement).getPropertyValue("--card");
  copy.prepend(paper);
  copy.setAttribute("width", String(box.width));
  copy.setAttribute("height", String(box.height));
  return new XMLSerializer().serializeToString(copy);
}

export function saveSvg(svg: SVGSVGElement, name: string): void {
  download(`${name}.svg`, new Blob([svgText(svg)], {type: "image/svg+xml"}));
}

export async function savePng(svg: SVGSVGElement, name: string): Promise<void> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgText(svg))}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  const scale = 2;
  canvas.width = image.width * scale;
  canvas.height = image.height * scale;
  canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
  canvas.toBlob((blob) => blob && download(`${name}.png`, blob));
}

const cell = (text: string): string => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);

/// Numbers as other programs read them: a plain minus, no spaces between digits. What begins like a formula of a
/// spreadsheet and is no number stays text.
function plain(element: Element): string {
  const text = (element.textContent ?? "").trim().replace(/\s+/g, " ").replace(/\u2212/g, "-").replace(/(\d)\u202f(?=\d)/g, "$1");
  return cell(/^[=+@-]/.test(text) && Number.isNaN(Number(text.replace(/[ °%m]+$/, ""))) ? `'${text}` : text);
}

export function csvText(table: HTMLTableElement): string {
  return [...table.rows].map((row) => [...row.cells].map(plain).join(",")).join("\n") + "\n";
}

export function saveCsv(table: HTMLTableElement, name: string): void {
  download(`${name}.csv`, new Blob([csvText(table)], {type: "text/csv"}));
}
