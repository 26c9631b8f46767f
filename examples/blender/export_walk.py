"""Writes the walk of a .blend's camera as a path file for `promenade render --path`.

    blender -b SCENE.blend --factory-startup -P export_walk.py -- --out WALK.json

A key for each frame of the scene's range, at the scene's frame rate: position, rotation and vertical field of view of its
camera, animated however it may be, in glTF's conventions (metres, y up, the camera looks along its -z).
"""

import argparse
import json
import math
import sys

import bpy
from mathutils import Matrix

# Blender's z up to glTF's y up.
GLTF_FROM_BLENDER = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))


def vertical_fov(camera, scene):
    """Degrees, of a picture of the scene's shape, whichever side of the sensor the lens is fitted to."""
    render = scene.render
    projection = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=render.resolution_x,
                                           y=render.resolution_y, scale_x=render.pixel_aspect_x,
                                           scale_y=render.pixel_aspect_y)
    return math.degrees(2.0 * math.atan(1.0 / projection[1][1]))


def key(scene, frame, frames_per_second):
    scene.frame_set(frame)
    camera = scene.camera  # markers may change it
    if camera is None or camera.data.type != "PERSP":
        raise ValueError("frame %d: expected a perspective camera that is the scene's own" % frame)
    eye, rotation, _ = (GLTF_FROM_BLENDER @ camera.matrix_world).decompose()
    return {"time": (frame - scene.frame_start) / frames_per_second, "eye": list(eye),
            "rotation": [rotation.x, rotation.y, rotation.z, rotation.w], "fov": vertical_fov(camera, scene)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", required=True)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    scene = bpy.context.scene
    frames_per_second = scene.render.fps / scene.render.fps_base
    # The frame after the last one is where a walk of so many frames ends.
    frames = range(scene.frame_start, scene.frame_end + 2)
    keys = [key(scene, frame, frames_per_second) for frame in frames]
    with open(options.out, "w") as stream:
        json.dump({"fps": frames_per_second, "interpolation": "linear", "keys": keys}, stream, indent=1)


try:
    main()
except Exception as error:  # Blender would print it and end with status 0
    print("export_walk.py:", error, file=sys.stderr)
    sys.exit(1)
