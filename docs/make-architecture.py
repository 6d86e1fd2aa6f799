#!/usr/bin/env python3
"""docs/make-architecture.py [--check]: draws docs/images/house.svg from the #includes of the code: folders, their rooms,
and who includes whom. An arrow that others imply is left out. --check: says whether the file is up to date."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DRAWING = ROOT / "docs/images/house.svg"
FOLDERS = ["core", "sim", "odometry", "recording", "report", "batch", "effects", "umbmark", "calibration", "gap",
           "experiment", "exchange", "cli"]
INCLUDE = re.compile(r'^\s*#\s*include\s*"([a-z_]+)/([^"]+)"', re.M)
WIDTH, BOX_HEIGHT, ROOM_HEIGHT, GAP_Y, MARGIN = 1160, 34, 15, 46, 20


def sources(folder):
    return sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in (".h", ".cpp") and "web" not in p.parts)


def room_of(folder, rest):
    """The first room below a folder that a path stands in; "" for the folder itself."""
    return rest.split("/")[0] if "/" in rest else ""


def read_includes():
    folders = {f: set() for f in FOLDERS}
    rooms = {f: {} for f in FOLDERS}
    for folder in FOLDERS:
        for path in sources(folder):
            own = room_of(folder, path.relative_to(ROOT / folder).as_posix())
            seen = rooms[folder].setdefault(own, set())
            for target, rest in INCLUDE.findall(path.read_text()):
                if target == folder:
                    seen.add(room_of(folder, rest))
                elif target in folders:
                    folders[folder].add(target)
    return folders, rooms


def reach(graph, start):
    found, todo = set(), list(graph[start])
    while todo:
        node = todo.pop()
        if node not in found:
            found.add(node)
            todo += graph[node]
    return found


def reduced(graph):
    """Without arrows that a longer way implies."""
    return {a: {b for b in to if not any(b in reach(graph, c) for c in to if c != b)} for a, to in graph.items()}


def layers(graph):
    depth = {}

    def of(node):
        if node not in depth:
            depth[node] = 1 + max((of(n) for n in graph[node]), default=-1)
        return depth[node]

    for node in graph:
        of(node)
    for node in graph:  # what includes nothing, and is not what all others stand on
        if not graph[node] and node != "core":
            depth[node] = 1
    return [[n for n in graph if depth[n] == d] for d in range(max(depth.values()), -1, -1)]


def in_data_order(rooms):
    """Rooms of a folder, each behind those that it includes; the folder's own files are no room."""
    graph = {r: {t for t in to if t and t != r and t in rooms} for r, to in rooms.items() if r}
    ordered = []
    while len(ordered) < len(graph):
        free = [r for r in sorted(graph) if r not in ordered and graph[r] <= set(ordered)]
        if not free:  # two rooms include each other
            free = [min(r for r in graph if r not in ordered)]
        ordered.append(free[0])
    return ordered


def lines_of(rooms, columns=30):
    lines, line = [], ""
    for i, room in enumerate(rooms):
        word = room + ("" if i + 1 == len(rooms) else " ›")
        if line and len(line) + 1 + len(word) > columns:
            lines.append(line)
            line = ""
        line = f"{line} {word}".strip()
    return lines + [line] if line else lines


def placed(rows, rooms, arrows):
    """Boxes row by row, each row in the order of those that point to it."""
    boxes, y = {}, MARGIN
    for row in rows:
        above = {f: [boxes[a][0] + boxes[a][2] / 2 for a in boxes if f in arrows[a]] for f in row}
        row = sorted(row, key=lambda f: sum(above[f]) / max(len(above[f]), 1))
        texts = {f: lines_of(in_data_order(rooms[f])) for f in row}
        widths = {f: max([len(f) * 10.5 + 34] + [len(t) * 6.4 + 24 for t in texts[f]]) for f in row}
        space = (WIDTH - 2 * MARGIN - sum(widths.values())) / len(row)
        x, tallest = MARGIN + space / 2, BOX_HEIGHT
        for f in row:
            height = BOX_HEIGHT + ROOM_HEIGHT * len(texts[f])
            boxes[f] = (x, y, widths[f], height, texts[f])
            x += widths[f] + space
            tallest = max(tallest, height)
        y += tallest + GAP_Y
    return boxes, y - GAP_Y + MARGIN


def drawing():
    folders, rooms = read_includes()
    arrows = reduced(folders)
    boxes, height = placed(layers(arrows), rooms, arrows)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:.0f}" font-family="sans-serif">',
           '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
           '<path d="M0 0 8 4 0 8z" fill="#667"/></marker></defs>',
           f'<rect width="{WIDTH}" height="{height:.0f}" fill="white"/>']
    for a in FOLDERS:
        for b in sorted(arrows[a]):
            ax, ay, aw, ah, _ = boxes[a]
            bx, by, bw, _, _ = boxes[b]
            out.append(f'<path d="M{ax + aw / 2:.0f} {ay + ah:.0f} C{ax + aw / 2:.0f} {ay + ah + 30:.0f} '
                       f'{bx + bw / 2:.0f} {by - 30:.0f} {bx + bw / 2:.0f} {by:.0f}" fill="none" stroke="#99a" '
                       f'marker-end="url(#tip)"><title>{a} includes {b}</title></path>')
    for f, (x, y, w, h, texts) in boxes.items():
        out.append(f'<rect x="{x:.0f}" y="{y:.0f}" width="{w:.0f}" height="{h:.0f}" rx="5" fill="#eef3fa" '
                   f'stroke="#456"/><text x="{x + w / 2:.0f}" y="{y + 22:.0f}" font-size="16" font-weight="bold" '
                   f'text-anchor="middle">{f}/</text>')
        for i, text in enumerate(texts):
            out.append(f'<text x="{x + w / 2:.0f}" y="{y + 40 + ROOM_HEIGHT * i:.0f}" font-size="12" fill="#333" '
                       f'text-anchor="middle">{text}</text>')
    return "\n".join(out) + "\n</svg>\n"


def main():
    if sys.argv[1:] == ["--check"]:
        if not DRAWING.exists() or DRAWING.read_text() != drawing():
            sys.exit(f"{DRAWING.relative_to(ROOT)} is not what the code includes; docs/make-architecture.py draws it again")
    elif len(sys.argv) == 1:
        DRAWING.write_text(drawing())
    else:
        sys.exit("usage: docs/make-architecture.py [--check]")


main()
