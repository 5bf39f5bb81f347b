# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the series of exportSurface into Blender: a frame of the film for each file, with water for its material.

    blender -b -P etc/blender/loadSeries.py -- CASE/export -o drop.blend [-scale 1000] [-render drop_]

Each mesh has the attributes "velocity", m/s times the scale, and "body", the number of its body of liquid. With -render the frames become PNG files.
"""
import argparse
import math
import pathlib
import sys

import bpy
import numpy


def read_ply(file):
    """Vertices' properties by their names, and triangles, of a binary file of exportSurface."""
    data = file.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    lines = data[:end].decode().splitlines()
    vertices, faces = (int(line.split()[2]) for line in lines if line.startswith("element"))
    names = [line.split()[2] for line in lines if line.startswith("property float")]
    if not {"x", "y", "z", "vx", "vy", "vz"} <= set(names):
        sys.exit(f"--> FATAL ERROR: {file} has no velocities: it is not of exportSurface -formats ply")
    table = numpy.frombuffer(data, numpy.dtype("<f4"), vertices*len(names), end).reshape(vertices, len(names))
    record = numpy.dtype([("corners", "u1"), ("vertices", "<i4", 3)])
    triangles = numpy.frombuffer(data, record, faces, end + table.nbytes)["vertices"]
    return {name: table[:, i] for i, name in enumerate(names)}, triangles


def water():
    material = bpy.data.materials.new("water")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    glass, output = nodes.new("ShaderNodeBsdfGlass"), nodes.new("ShaderNodeOutputMaterial")
    glass.inputs["Roughness"].default_value = 0
    glass.inputs["IOR"].default_value = 1.333
    links.new(glass.outputs[0], output.inputs["Surface"])
    return material


def add_frame(number, file, scale, material):
    columns, triangles = read_ply(file)
    places = scale*numpy.stack([columns[name] for name in ("x", "y", "z")], axis=1)
    mesh = bpy.data.meshes.new(file.stem)
    mesh.from_pydata(places.tolist(), [], triangles.tolist())
    velocity = mesh.attributes.new("velocity", "FLOAT_VECTOR", "POINT")
    velocity.data.foreach_set("vector", scale*numpy.stack([columns[name] for name in ("vx", "vy", "vz")], axis=1).ravel())
    if "body" in columns:
        mesh.attributes.new("body", "INT", "POINT").data.foreach_set("value", columns["body"].astype("i4"))
    mesh.polygons.foreach_set("use_smooth", [True]*len(mesh.polygons))
    mesh.materials.append(material)
    thing = bpy.data.objects.new(file.stem, mesh)
    bpy.context.scene.collection.objects.link(thing)
    for frame, is_hidden in ((number - 1, True), (number, False), (number + 1, True)):
        for name in ("hide_render", "hide_viewport"):
            setattr(thing, name, is_hidden)
            thing.keyframe_insert(name, frame=frame)
    return places


def add_surroundings(low, high):
    """A floor below the lowest place, a sky, and a camera that sees all of the series."""
    centre, size = (low + high)/2, float(numpy.linalg.norm(high - low))
    bpy.ops.mesh.primitive_plane_add(size=20*size, location=(centre[0], centre[1], low[2]))
    sky = bpy.data.worlds.new("sky")
    sky.use_nodes = True
    sky.node_tree.nodes["Background"].inputs["Color"].default_value = (0.7, 0.8, 1, 1)
    bpy.context.scene.world = sky
    bpy.ops.object.light_add(type="SUN", rotation=(math.radians(40), 0, math.radians(30)))
    bpy.context.object.data.energy = 3
    bpy.ops.object.camera_add(location=(centre[0], centre[1] - 1.6*size, centre[2] + 0.5*size), rotation=(math.radians(73), 0, 0))
    camera = bpy.context.object
    camera.data.clip_start, camera.data.clip_end = size/100, 100*size
    bpy.context.scene.camera = camera


def main():
    parser = argparse.ArgumentParser(prog="loadSeries.py")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("-o", dest="output", type=pathlib.Path, required=True)
    parser.add_argument("-scale", type=float, default=1000, help="Blender's units a metre")
    parser.add_argument("-render", metavar="PREFIX", help="render all frames to PREFIX0001.png ...")
    parser.add_argument("-samples", type=int, default=64)
    args = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])
    files = sorted(args.folder.glob("liquid_*.ply"))
    if not files:
        sys.exit(f"--> FATAL ERROR: {args.folder} has no liquid_*.ply: run exportSurface first")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material = water()
    frames = [add_frame(number, file, args.scale, material) for number, file in enumerate(files, 1)]
    places = [frame for frame in frames if len(frame)]
    if not places:
        sys.exit(f"--> FATAL ERROR: {args.folder} has no liquid")
    add_surroundings(numpy.min([p.min(axis=0) for p in places], axis=0), numpy.max([p.max(axis=0) for p in places], axis=0))
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, len(files)
    scene.frame_set(1)
    scene.render.engine, scene.cycles.samples = "CYCLES", args.samples
    bpy.ops.wm.save_as_mainfile(filepath=str(args.output.resolve()))
    print(f"Written: {args.output}, {len(files)} frames")
    if args.render:
        scene.render.filepath = str(pathlib.Path(args.render).resolve())
        bpy.ops.render.render(animation=True)


main()
