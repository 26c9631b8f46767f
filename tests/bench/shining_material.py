#!/usr/bin/env python3
"""A copy of a .glb scene, as one .gltf file, in which a material shines: scenes whose lamps came without light.

    tests/bench/shining_material.py ../shared/scenes/cornell-box/cornellBox.glb light.000 10 out/cornell.gltf

The radiance, in the scene's units, is the same for red, green and blue. With --without-reflection all materials lose what
they reflect at the surface (KHR_materials_specular), so that what is left is Lambert's law, which all renderers agree on.
"""
import argparse
import base64
import json
import pathlib
import struct
import sys

MAGIC, JSON_CHUNK, BINARY_CHUNK = b"glTF", 0x4E4F534A, 0x004E4942
CHUNK_HEADER = struct.Struct("<II")  # length, type


def chunks_of(glb):
    """By type; after the header of three numbers (glTF 2.0, 4.4)."""
    if glb[:4] != MAGIC:
        sys.exit("not a .glb file")
    chunks, at = {}, 12
    while at < len(glb):
        length, kind = CHUNK_HEADER.unpack_from(glb, at)
        at += CHUNK_HEADER.size
        chunks[kind] = glb[at:at + length]
        at += length
    return chunks


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("material")
    parser.add_argument("radiance", type=float)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--without-reflection", action="store_true")
    options = parser.parse_args()
    chunks = chunks_of(options.scene.read_bytes())
    scene = json.loads(chunks[JSON_CHUNK])
    named = [material for material in scene["materials"] if material.get("name") == options.material]
    if not named:
        sys.exit(f"{options.scene}: no material is called {options.material!r}")
    for material in named:
        material["emissiveFactor"] = [1.0, 1.0, 1.0]
        material.setdefault("extensions", {})["KHR_materials_emissive_strength"] = {"emissiveStrength": options.radiance}
    used = {*scene.get("extensionsUsed", []), "KHR_materials_emissive_strength"}
    if options.without_reflection:
        used.add("KHR_materials_specular")
        for material in scene["materials"]:
            material.setdefault("extensions", {})["KHR_materials_specular"] = {"specularFactor": 0.0}
    scene["extensionsUsed"] = sorted(used)
    binary = chunks[BINARY_CHUNK][:scene["buffers"][0]["byteLength"]]  # chunks are padded
    scene["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps(scene))


if __name__ == "__main__":
    main()
