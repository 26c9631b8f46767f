"""Renders one frame with Blender Cycles for `promenade render --renderer`.

    blender -b [SCENE.blend] --factory-startup -P render_frame.py -- --camera REQUEST.json --out FRAME.exr \
        [--scene SCENE.gltf] [--samples N] [--environment R,G,B]

The scene is the .blend that Blender opened, or a glTF that is imported. The request is what Promenade writes: size,
vertical field of view and worldFromCamera in glTF's conventions (metres, y up). The frame is an OpenEXR file with linear
R G B, Z (32 bits, along the view axis) and the camera as worldToCamera and worldToNDC, so that it serves
`promenade render --from`, too.
"""

import argparse
import json
import math
import os
import struct
import sys

import numpy

if "bool" not in vars(numpy):
    numpy.bool = bool  # Debian 12: the glTF importer of Blender 3.4 is older than its NumPy

import bpy
from mathutils import Matrix

# glTF's y up to Blender's z up.
BLENDER_FROM_GLTF = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--camera", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--scene", default="")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--environment", default="", help="uniform light from infinity: R,G,B")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


def import_scene(file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # COMPAT keeps glTF's numbers: a light of 1 lx or 1 cd is as bright, beside what shines with 1, as in Promenade. The
    # importer would divide lights alone by 683 lm/W.
    bpy.ops.import_scene.gltf(filepath=file, convert_lighting_mode="COMPAT")


def set_environment(colour):
    world = bpy.context.scene.world or bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*colour, 1.0)
    background.inputs["Strength"].default_value = 1.0


def set_camera(request):
    data = bpy.data.cameras.new("promenade")
    data.sensor_fit = "VERTICAL"
    data.angle = request["vertical_fov"]
    data.clip_start = 0.001
    data.clip_end = 1e6
    camera = bpy.data.objects.new("promenade", data)
    bpy.context.scene.collection.objects.link(camera)
    camera.matrix_world = BLENDER_FROM_GLTF @ Matrix(request["world_from_camera"])
    bpy.context.scene.camera = camera


def render(request, options):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = options.samples
    scene.cycles.seed = options.seed + request["frame"]
    scene.cycles.use_denoising = False
    # One sample of Promenade's is one pixel here: a narrow filter keeps edges between pixels, where Z has them.
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.filter_width = 0.01
    scene.render.resolution_x = request["width"]
    scene.render.resolution_y = request["height"]
    scene.render.resolution_percentage = 100
    scene.render.pixel_aspect_x = scene.render.pixel_aspect_y = 1.0
    scene.render.use_border = False
    scene.render.use_motion_blur = False
    scene.render.use_multiview = False
    scene.render.use_compositing = False
    scene.render.use_sequencer = False
    # One picture a file: the layer that was last looked at.
    for layer in scene.view_layers:
        layer.use = layer == bpy.context.view_layer
    bpy.context.view_layer.use_pass_z = True
    output = scene.render.image_settings
    output.file_format = "OPEN_EXR_MULTILAYER"
    output.color_depth = "32"
    output.exr_codec = "ZIP"
    scene.render.filepath = options.out
    bpy.ops.render.render(write_still=True)


def world_to_camera(request):
    """Rows of row vectors, left-handed camera space, z into the picture, as OpenEXR defines it."""
    m = request["world_from_camera"]
    axes = [[m[r][0] for r in range(3)], [m[r][1] for r in range(3)], [-m[r][2] for r in range(3)]]
    eye = [m[r][3] for r in range(3)]
    rows = [[axes[c][r] for c in range(3)] + [0.0] for r in range(3)]
    rows.append([-sum(eye[r] * axes[c][r] for r in range(3)) for c in range(3)] + [1.0])
    return rows


def world_to_ndc(request):
    """Divided by w: (0, 0) the upper left corner of the image, (1, 1) the lower right."""
    focal = 0.5 / math.tan(0.5 * request["vertical_fov"])
    across = focal * request["height"] / request["width"]
    project = [[across, 0, 0, 0], [0, -focal, 0, 0], [0.5, 0.5, 1, 1], [0, 0, -0.01, 0]]
    rows = world_to_camera(request)
    return [[sum(rows[r][k] * project[k][c] for k in range(4)) for c in range(4)] for r in range(4)]


def header_end(data):
    """Where the attributes of a single-part OpenEXR file end, and how many lines of pixels a chunk has."""
    at, lines = 8, 1
    while data[at] != 0:
        name_end = data.index(0, at)
        type_end = data.index(0, name_end + 1)
        size = struct.unpack_from("<i", data, type_end + 1)[0]
        if data[at:name_end] == b"compression":
            # none, RLE, ZIPS: 1; ZIP: 16; PIZ: 32; PXR24: 16; B44, B44A: 32; DWAA: 32; DWAB: 256
            lines = (1, 1, 1, 16, 32, 16, 32, 32, 32, 256)[data[type_end + 5]]
        at = type_end + 5 + size
    return at, lines


def add_attributes(file, matrices):
    """Blender writes no camera: it is put into the header, and the table of chunks moved along."""
    with open(file, "rb") as stream:
        data = stream.read()
    end, lines = header_end(data)
    more = b"".join(name.encode() + b"\0m44f\0" + struct.pack("<i16f", 64, *(v for row in rows for v in row))
                    for name, rows in matrices.items())
    first = struct.unpack_from("<Q", data, end + 1)[0]
    chunks = (first - (end + 1)) // 8
    table = [offset + len(more) for offset in struct.unpack_from("<%dQ" % chunks, data, end + 1)]
    with open(file, "wb") as stream:
        stream.write(data[:end] + more + b"\0" + struct.pack("<%dQ" % chunks, *table) + data[first:])


def main():
    options = arguments()
    with open(options.camera) as stream:
        request = json.load(stream)
    if options.scene.lower().endswith((".gltf", ".glb")):
        import_scene(options.scene)
    if options.environment:
        set_environment([float(v) for v in options.environment.split(",")])
    set_camera(request)
    out = options.out
    options.out = os.path.abspath(out) + ".part.exr"
    render(request, options)
    add_attributes(options.out, {"worldToCamera": world_to_camera(request), "worldToNDC": world_to_ndc(request)})
    os.replace(options.out, out)


try:
    main()
except Exception as error:  # Blender would print it and end with status 0
    print("render_frame.py:", error, file=sys.stderr)
    sys.exit(1)
