"""Renders one frame of a glTF scene by Cycles, with several numbers of samples one after the other. Runs inside
Blender, for against_cycles.py, where what is measured is said.

    blender --background --factory-startup --python cycles_frame.py -- '{"scene": "hall.gltf", ...}'

The keys are read in main(). Images are OpenEXR of 32 bits in linear Rec.709. `times`, a JSON file, gets the
processor's seconds: "start" (of Blender, import, hierarchy, one sample a pixel) and those of each image by its name.
"""
import json
import math
import pathlib
import sys
import time

import bpy
import mathutils
import numpy

# Debian 12's importer (of Blender 3.4) names what its NumPy (1.24) has no more.
numpy.bool = bool

# glTF's y is up, Blender's z: (x, y, z) -> (x, -z, y), as the importer has it.
BLENDER_FROM_GLTF = mathutils.Matrix(((1, 0, 0), (0, 0, -1), (0, 1, 0)))


def place_camera(scene, job):
    """`axes`: right, up and backward; `eye`; both in the glTF file's world."""
    data = bpy.data.cameras.new("frame")
    data.sensor_fit = "VERTICAL"
    data.angle = job["vertical_field_of_view"]
    data.clip_start = 1e-3
    data.clip_end = 1e5
    camera = bpy.data.objects.new("frame", data)
    axes = BLENDER_FROM_GLTF @ mathutils.Matrix(job["axes"]).transposed()
    camera.matrix_world = mathutils.Matrix.Translation(BLENDER_FROM_GLTF @ mathutils.Vector(job["eye"])) @ axes.to_4x4()
    scene.collection.objects.link(camera)
    scene.camera = camera


def make_thin(material):
    """KHR_materials_transmission without a volume is a thin pane. The importer makes a refracting solid of it,
    which an open pane is not. Here: a mirror by Fresnel's share F of one side, the rest straight through; of both
    sides, 2 F / (1 + F), is what the pane reflects."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    output = next(n for n in nodes if n.type == "OUTPUT_MATERIAL")
    fresnel, glossy = nodes.new("ShaderNodeFresnel"), nodes.new("ShaderNodeBsdfGlossy")
    fresnel.inputs["IOR"].default_value = 1.5
    # A back face turned to the eye would have 1 / IOR, hence total reflection: the cosine is taken from the front.
    geometry, flip = nodes.new("ShaderNodeNewGeometry"), nodes.new("ShaderNodeMath")
    ior = nodes.new("ShaderNodeMath")
    flip.operation, flip.inputs[1].default_value = "MULTIPLY", 1.0 / 1.5 - 1.5
    ior.operation, ior.inputs[1].default_value = "ADD", 1.5
    links.new(geometry.outputs["Backfacing"], flip.inputs[0])
    links.new(flip.outputs[0], ior.inputs[0])
    links.new(ior.outputs[0], fresnel.inputs["IOR"])
    double, plus, share = (nodes.new("ShaderNodeMath") for _ in range(3))
    double.operation, double.inputs[1].default_value = "MULTIPLY", 2.0
    plus.operation, plus.inputs[1].default_value = "ADD", 1.0
    share.operation = "DIVIDE"
    links.new(fresnel.outputs[0], double.inputs[0])
    links.new(fresnel.outputs[0], plus.inputs[0])
    links.new(double.outputs[0], share.inputs[0])
    links.new(plus.outputs[0], share.inputs[1])
    glossy.inputs["Roughness"].default_value = 0.0
    transparent, mix = nodes.new("ShaderNodeBsdfTransparent"), nodes.new("ShaderNodeMixShader")
    links.new(share.outputs[0], mix.inputs[0])
    links.new(transparent.outputs[0], mix.inputs[1])
    links.new(glossy.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], output.inputs["Surface"])


def make_matt(material):
    """A surface that reflects nothing above its matt layer (KHR_materials_specular with a factor of 0) follows Lambert's law in
    glTF. The importer makes a Principled BSDF of all surfaces, whose matt layer is Burley's: where it is rough it gives
    back more at grazing angles, up to more than it receives."""
    nodes, links = material.node_tree.nodes, material.node_tree.links
    principled = next(n for n in nodes if n.type == "BSDF_PRINCIPLED")
    output = next(n for n in nodes if n.type == "OUTPUT_MATERIAL")
    diffuse, emission, both = (nodes.new(kind) for kind in ("ShaderNodeBsdfDiffuse", "ShaderNodeEmission", "ShaderNodeAddShader"))
    for source, (target, socket) in {"Base Color": (diffuse, "Color"), "Normal": (diffuse, "Normal"), "Emission": (emission, "Color"),
                                     "Emission Strength": (emission, "Strength")}.items():
        if principled.inputs[source].is_linked:
            links.new(principled.inputs[source].links[0].from_socket, target.inputs[socket])
        elif source != "Normal":
            target.inputs[socket].default_value = principled.inputs[source].default_value
    links.new(diffuse.outputs[0], both.inputs[0])
    links.new(emission.outputs[0], both.inputs[1])
    links.new(both.outputs[0], output.inputs["Surface"])


def give_sky(scene, radiance):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (radiance, radiance, radiance, 1.0)
    background.inputs["Strength"].default_value = 1.0
    scene.world = world


def sharpen_lights():
    """glTF's lights are points and directions; the importer gives them a size."""
    for light in bpy.data.lights:
        light.shadow_soft_size = 0.0
        if light.type == "SUN":
            light.angle = 0.0


def set_up(scene, job):
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = job["size"]
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", job["threads"]
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.use_file_extension = False
    # The hierarchy of the first image serves for the others.
    render.use_persistent_data = True
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    # Nothing is cut off or blurred, on either side.
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.blur_glossy = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    # Promenade's 8 scatterings: Cycles counts from the second one on.
    bounces = job["bounces"] - 1
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = bounces
    cycles.volume_bounces = 0
    cycles.transparent_max_bounces = 64
    # Promenade's pixel is the mean over its square.
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0


def rendered(scene, samples, seed, output):
    """Seconds of the processor, all threads."""
    scene.cycles.samples, scene.cycles.seed = samples, seed
    scene.render.filepath = output
    before = time.process_time()
    bpy.ops.render.render(write_still=True)
    return time.process_time() - before


def main():
    job = json.loads(sys.argv[sys.argv.index("--") + 1])
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # COMPAT keeps glTF's numbers: a light of 1 cd is as bright, beside a surface that shines with 1, as there.
    bpy.ops.import_scene.gltf(filepath=job["scene"], convert_lighting_mode="COMPAT")
    scene = bpy.context.scene
    for name in job["thin"]:
        make_thin(bpy.data.materials[name])
    for name in job["matt"]:
        make_matt(bpy.data.materials[name])
    sharpen_lights()
    give_sky(scene, job["sky"])
    place_camera(scene, job)
    set_up(scene, job)
    assert math.isclose(scene.camera.data.angle_y, job["vertical_field_of_view"], rel_tol=1e-5)
    rendered(scene, 1, 0, job["images"][0]["output"])
    seconds = {"start": time.process_time()}
    for image in job["images"]:
        seconds[image["name"]] = rendered(scene, image["samples"], image["seed"], image["output"])
    pathlib.Path(job["times"]).write_text(json.dumps(seconds))


main()
