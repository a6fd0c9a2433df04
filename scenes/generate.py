#!/usr/bin/env python3
"""Writes the larger scenes of this folder; each is a module of generator/. Deterministic; standard
library only. Usage: python3 scenes/generate.py [folder]

Conventions are pbrt's: x right, y up, z into the picture (left-handed as seen by the camera),
lengths in metres, and a triangle's normal is cross(p1 - p0, p2 - p0), out of the solid.
"""
import os
import sys

from generator.bidir_room import bidir_room
from generator.door_ajar import door_ajar
from generator.env_garden import env_garden
from generator.fur_balls import fur_balls
from generator.glass_caustics import glass_caustics
from generator.mis_plates import mis_plates


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    for name, scene in (("door-ajar", door_ajar), ("glass-caustics", glass_caustics),
                        ("bidir-room", bidir_room), ("mis-plates", mis_plates),
                        ("env-garden", env_garden), ("fur-balls", fur_balls)):
        text = scene()
        with open(os.path.join(folder, name + ".txt"), "w", encoding="ascii", newline="\n") as file:
            file.write(text)
        print(f"{name}.txt: {len(text) // 1000} kB")


if __name__ == "__main__":
    main()
