#!/usr/bin/env python3
"""A room full of mirrors, and a walk through it: a path that image-based rendering cannot help.

    tests/bench/mirror_room.py out
    promenade render out/room.gltf --path out/walk.json --exposure 0 [--method full] --out ...

All four walls and the ceiling are mirrors, and so are two of the five boxes on the floor; what a warp could use is the
floor and three boxes of one colour each. Metres, y up; a lamp of 1 x 1 m hangs below the ceiling.
"""
import argparse
import base64
import json
import pathlib
import struct

# Of a cube from -1 to 1: (normal, two edges), edge 1 x edge 2 = normal.
FACES = [((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((-1, 0, 0), (0, 0, 1), (0, 1, 0)),
         ((0, 1, 0), (0, 0, 1), (1, 0, 0)), ((0, -1, 0), (1, 0, 0), (0, 0, 1)),
         ((0, 0, 1), (1, 0, 0), (0, 1, 0)), ((0, 0, -1), (0, 1, 0), (1, 0, 0))]
MIRROR, FLOOR, LAMP, RED, GREEN, BLUE = range(6)


def matt(colour):
    return {"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1], "metallicFactor": 0, "roughnessFactor": 1}}


MATERIALS = [
    {"name": "mirror", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.9, 0.9, 1], "metallicFactor": 1,
                                                "roughnessFactor": 0}},
    {"name": "floor", **matt((0.5, 0.4, 0.3))},
    {"name": "lamp", **matt((0, 0, 0)), "emissiveFactor": [1, 1, 1],
     "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 10}}},
    {"name": "red", **matt((0.7, 0.1, 0.1))}, {"name": "green", **matt((0.1, 0.6, 0.1))},
    {"name": "blue", **matt((0.1, 0.2, 0.7))}]

# Centre, half the edges, material; the first is the room, seen from within.
BOXES = [((0, 1.5, 0), (3, 1.5, 3), None), ((0, 2.9, 0), (0.5, 0.02, 0.5), LAMP),
         ((-1.6, 0.5, -1.2), (0.4, 0.5, 0.4), RED), ((1.5, 0.3, -0.4), (0.3, 0.3, 0.3), GREEN),
         ((-0.4, 0.4, -2.0), (0.3, 0.4, 0.3), BLUE), ((0.6, 0.7, -1.8), (0.3, 0.7, 0.3), MIRROR),
         ((-1.9, 0.3, 0.8), (0.3, 0.3, 0.3), MIRROR)]

WALK = {"fps": 25, "keys": [{"time": 0, "eye": [1.8, 1.6, 2.4], "target": [-0.6, 0.8, -1.5], "fov": 55},
                            {"time": 2, "eye": [0.4, 1.5, 1.8], "target": [-0.6, 0.8, -1.8]},
                            {"time": 4, "eye": [-1.2, 1.5, 1.6], "target": [0.4, 0.8, -1.6]}]}


class Binary:
    def __init__(self):
        self.bytes, self.views, self.accessors = b"", [], []

    def add(self, values, code, component_type, kind, **limits):
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": 4 * len(values)})
        self.bytes += struct.pack(f"<{len(values)}{code}", *values)
        per_element = {"VEC3": 3, "SCALAR": 1}[kind]
        self.accessors.append({"bufferView": len(self.views) - 1, "componentType": component_type, "type": kind,
                               "count": len(values) // per_element, **limits})
        return len(self.accessors) - 1


def quad(binary, centre, half, face, material):
    """A face of a box, or without material of the room, as a primitive."""
    normal, u, v = face
    corners = [[c + h * (n + a * s + b * t) for c, h, n, s, t in zip(centre, half, normal, u, v)]
               for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    lows, highs = [min(x) for x in zip(*corners)], [max(x) for x in zip(*corners)]
    order = (0, 1, 2, 0, 2, 3)
    if material is None:
        order, material = (0, 2, 1, 0, 3, 2), FLOOR if normal == (0, -1, 0) else MIRROR
    return {"attributes": {"POSITION": binary.add([x for p in corners for x in p], "f", 5126, "VEC3", min=lows, max=highs)},
            "indices": binary.add(order, "I", 5125, "SCALAR"), "material": material}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    folder = parser.parse_args().folder
    binary = Binary()
    meshes = [{"primitives": [quad(binary, centre, half, face, material)]}
              for centre, half, material in BOXES for face in FACES]
    scene = {
        "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_emissive_strength"], "materials": MATERIALS,
        "meshes": meshes, "nodes": [{"mesh": i} for i in range(len(meshes))],
        "scenes": [{"nodes": list(range(len(meshes)))}], "scene": 0,
        "accessors": binary.accessors, "bufferViews": binary.views,
        "buffers": [{"byteLength": len(binary.bytes),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(binary.bytes).decode()}]}
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "room.gltf").write_text(json.dumps(scene))
    (folder / "walk.json").write_text(json.dumps(WALK, indent=2))


if __name__ == "__main__":
    main()
