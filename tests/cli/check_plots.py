#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the theory that tools/plot draws, and that it draws runs in two and three dimensions.

Usage: check_plots.py PROGRAM (meniscus)
"""

import html.parser
import io
import math
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

import numpy as np
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tools/plotting"))
import directors  # noqa: E402
import drop_theory  # noqa: E402
import movies  # noqa: E402
import nematics  # noqa: E402
import partners  # noqa: E402
import sections  # noqa: E402
import style  # noqa: E402
from results import Results  # noqa: E402

PROGRAM = sys.argv.pop(1)

SCENE = """
dimension = {dimension}
time.end = 0.05
[output]
frames_every = 0.01
history_every = 0.002
fields = ["velocity", "F", "pressure"]
measures = ["drop.p2", "drop.area"]
[[body]]
name = "drop"
{shape}
material = {{ type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.9 }}
[[surface_tension]]
body = "drop"
gamma = 1
[expect]
aspect = {{ of = "drop.aspect", at = 0.02, value = 1.2, within = 1 }}
"""


class Page(html.parser.HTMLParser):
    """Parses a page: its text, the sources of its pictures, and elements that are not closed."""

    def __init__(self):
        super().__init__()
        self.text, self.sources, self.open = "", [], []

    def handle_starttag(self, tag, attrs):
        if tag == "img":
            self.sources.append(dict(attrs)["src"])
        elif tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += " " + data


class Theory(unittest.TestCase):
    # sigma R^2/nu of the second mode (RKPM note 7).
    ROOTS = {
        0.05: 4.374694 + 55.97045j,
        0.2: 3.761214 + 13.24429j,
        0.5: 3.592872 + 4.133751j,
        1: 1.2803195,
        2: 0.2735324,
    }

    def test_second_mode(self):
        for ohnesorge, root in self.ROOTS.items():
            self.assertLess(abs(drop_theory.slow_rate(ohnesorge) / ohnesorge / root - 1), 2e-7)

    def test_rate_of_the_nano_drop(self):
        # 2.846054e10 1/s at T = 50.74987 ps
        rate = drop_theory.slow_rate(0.929506) / 50.74987e-12
        self.assertLess(abs(rate / 2.846054e10 - 1), 1e-6)

    def test_creeping_limit(self):
        self.assertLess(abs(drop_theory.slow_rate(1000) * 1000 * 19 / 20 - 1), 1e-6)

    def test_critical_point(self):
        self.assertIsInstance(drop_theory.slow_rate(0.76644), complex)
        self.assertIsInstance(drop_theory.slow_rate(0.76648), float)


class Words(unittest.TestCase):
    def test_names(self):
        for key, words in (("von_mises", "von Mises stress"), ("force_x", "force $x$"), ("J", "volume ratio J"),
                           ("base_radius", "base radius"), ("cavity_gap", "cavity gap"), ("x", "x")):  # fmt: skip
            self.assertEqual(style.column_name(key), words)

    def test_units(self):
        for unit, printed in (("m^2", "m²"), ("um", "µm"), ("ag/(nm ps^2)", "ag/(nm ps²)"), ("m^-1", "m⁻¹"),
                              ("deg", "°"), ("s", "s"), ("um^3/us", "µm³/µs")):  # fmt: skip
            self.assertEqual(style.pretty(unit), printed)



class Pictures(unittest.TestCase):
    def draw(self, dimension, shape, *options, tables="", scene=SCENE):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            path = folder / "scene.toml"
            path.write_text(scene.format(dimension=dimension, shape=shape) + tables)
            run = folder / "run"
            subprocess.run([PROGRAM, "run", "-q", path, "--output", run], check=True)
            script = ROOT / "tools/plotting/plot.py"
            done = subprocess.run(
                ["/usr/bin/python3", "-B", script, run, *options], capture_output=True, text=True
            )
            self.files = {path.name: path.read_bytes() for path in run.glob("plots/*")}
            pictures = {path.stem: path.stat().st_size for path in run.glob("plots/*.png")}
            return done, pictures

    def test_three_dimensions(self):
        shape = "shape = 'ellipsoid'\nsemi_axes = [1, 1.2, 1]\ncore = 4\nlayers = 2"
        done, pictures = self.draw(3, shape)
        self.assertEqual(done.returncode, 0, done.stderr)
        names = {
            "energies", "drop_shape", "drop_measures", "drop_decay", "sections_pressure", "surface"
        }  # fmt: skip
        self.assertEqual(set(pictures), names)
        self.assertGreater(min(pictures.values()), 10000)  # an empty picture is smaller

    def test_directors(self):
        """Directors in the plane of x and z: one with length one along x, one half out of the plane, one zero."""
        values = {
            "director": np.array([[1, 0, 0], [0, -0.5, 0], [0, 0, 0.25]]),
            "position": np.array([[0, 0, 0], [1, 0, 2], [3, 0, 3]]),
        }
        run = types.SimpleNamespace(
            fields=["director"],
            field=lambda frame, name, body: values[name],
            points=lambda frame, body: values["position"],
        )
        rods = directors.rods(run, 0, types.SimpleNamespace(spacing=0.5), np.ones(3, bool), [0, 2])
        expected = [[[-0.2, 0], [0.2, 0]], [[1, 2], [1, 2]], [[3, 2.95], [3, 3.05]]]
        np.testing.assert_allclose(rods, expected, atol=1e-15)
        run.fields = []
        self.assertEqual(len(directors.rods(run, 0, None, None, None)), 0)

    def test_shell(self):
        shape = "shape = 'disk_shell'\nradius = 1\nheight = 1\nthickness = 0.3\nspacing = 0.3"
        profile = "\n[[profile]]\nbody = 'drop'\nr = [0, 1]\nz = [0.5, 0]"
        done, pictures = self.draw(3, shape, tables=profile)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("cell_drop", pictures)
        self.assertGreater(min(pictures.values()), 10000)

    def test_two_dimensions(self):
        shape = "shape = 'ellipse'\nsemi_axes = [1, 1.2]\ncore = 4\nrings = 2"
        done, pictures = self.draw(2, shape, "--field", "velocity", "--frames", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        names = {"energies", "drop_shape", "drop_measures", "sections_velocity"}
        self.assertEqual(set(pictures), names)
        self.assertGreater(min(pictures.values()), 10000)

    def test_drops_on_walls(self):
        wall = """
[[contact]]
name = "wall"
bodies = ["drop"]
contact_angle = 80
points = 4
[contact.partner]
type = "half_space"
"""
        shapes = {
            2: "shape = 'disk'\nradius = 1\ncore = 4\nrings = 2",
            3: "shape = 'ball'\nradius = 1\ncore = 4\nlayers = 2",
        }
        places = {
            2: "point = [0, -1.1]\nnormal = [0, 1]",
            3: "point = [0, 0, -1.1]\nnormal = [0, 0, 1]\n[[remap]]\nbody = 'drop'\nat = [0.03]",
        }
        measured = '"wall.base_radius", "wall.contact_angle", "drop.area"'
        for dimension, shape in shapes.items():
            scene = SCENE.replace('"drop.p2", "drop.area"', measured)
            done, pictures = self.draw(
                dimension, shape, "--frames", "2", tables=wall + places[dimension], scene=scene
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            names = {"wall_profile", "wall_front"} | ({"wall_patch"} if dimension == 3 else set())
            self.assertEqual({name for name in pictures if "wall" in name}, names)
            self.assertGreater(min(pictures.values()), 10000)

    def test_sections_contain_the_normals_of_walls(self):
        """The section of a ball across z, and on a wall or ground along its normal. An oblique wall has no
        influence."""
        corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
        ball = types.SimpleNamespace(X=corners, settings={"shape": "ball"})
        for contact, axes in (
            ({}, [0, 1]),
            ({"partner": {"type": "half_space", "normal": [0, 0, 1]}}, [0, 2]),
            ({"partner": {"type": "ball", "centre": [0, 0, 0]}}, [0, 1]),
            ({"up": [0, 1, 0]}, [0, 1]),
            ({"up": [0, 0, 1]}, [0, 2]),
            ({"partner": {"type": "half_space", "normal": [1, 1, 1]}}, [0, 1]),
        ):
            run = types.SimpleNamespace(bodies=[ball], input={"contact": [contact]})
            self.assertEqual(sections.Plane(run).axes, axes, contact)

    def test_nematic_drops(self):
        """Force dipole and tilt. A section along x and z is seen from -y."""
        plane = types.SimpleNamespace(axes=[0, 2])
        np.testing.assert_array_equal(nematics.out_of_picture(plane), [0, -1, 0])
        director = 'type = "nematic", frank_constant = 0.2, rotational_viscosity = 0.5'
        director += ', initial_director = [{direction}]'
        for dimension, shape, direction in (
            (2, "shape = 'ellipse'\nsemi_axes = [1, 1.2]\ncore = 4\nrings = 2", "0.6, 0.8"),
            (3, "shape = 'ellipsoid'\nsemi_axes = [1, 1.2, 1]\ncore = 4\nlayers = 2", "0, 0.6, 0.8"),
        ):
            scene = SCENE.replace('type = "newtonian"', director.replace("{direction}", direction))
            scene = scene.replace('"velocity", "F", "pressure"', '"director", "director_couple", "director_tilt"')
            scene = scene.replace('"drop.p2"', '"drop.director_couple"')
            done, pictures = self.draw(dimension, shape, "--frames", "2", scene=scene)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("drop_director", pictures)
            self.assertGreater(min(pictures.values()), 10000)

    def test_drops_on_ground(self):
        ground = """
[[body]]
name = "layer"
shape = "rectangle"
size = [4, 0.8]
spacing = 0.2
corner = [-2, -0.8]
material = { type = "neo_hookean", density = 1, youngs_modulus = 20, poissons_ratio = 0.4 }
[[held]]
body = "layer"
where = "y < -0.79"
[[contact]]
name = "line"
bodies = ["drop", "layer"]
adhesion = 0.5
up = [0, 1]
range = 0.3
offset = 0.1
points = 4
"""
        shape = "shape = 'disk'\nradius = 1\ncore = 4\nrings = 2\ncentre = [0, 1.1]"
        done, pictures = self.draw(2, shape, "--frames", "2", tables=ground)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("line_ground", pictures)
        self.assertGreater(min(pictures.values()), 10000)

    def test_report(self):
        """The report is one self-contained page with expectations, warnings, pictures, input and provenance."""
        shape = "shape = 'ellipse'\nsemi_axes = [1, 1.2]\ncore = 4\nrings = 2\nintegration = 'nodal'"
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            scene = "title = 'A <drop> & more'\n" + SCENE.format(dimension=2, shape=shape)
            scene += "missed = { of = 'drop.aspect', at = 0.02, value = 9, within = 1 }\n"
            (folder / "scene.toml").write_text(scene)
            subprocess.run(
                [PROGRAM, "run", folder / "scene.toml", "--output", folder / "run"],
                capture_output=True, check=False,
            )  # fmt: skip
            script = ROOT / "tools/plotting/report.py"
            report = subprocess.run(
                ["/usr/bin/python3", "-B", script, folder / "run"], capture_output=True, text=True
            )
            self.assertEqual(report.returncode, 0, report.stderr)
            page = (folder / "run/report.html").read_text()
        reader = Page()
        reader.feed(page)
        self.assertEqual(reader.open, [])
        self.assertEqual(len(reader.sources), 4)
        for source in reader.sources:  # the page loads nothing from elsewhere
            self.assertTrue(source.startswith("data:image/png;base64,iVBOR"))
        text = " ".join(reader.text.split())
        for words in ("A <drop> & more", "aspect", "MISSED", "met", "drop.p2", "drop ellipse newtonian",
                      'type = "newtonian"', "git_hash", "mean spacing",
                      "nodal\" has modes without energy and is unstable"):  # fmt: skip
            self.assertIn(words, text)

    def test_sweeps_and_convergence(self):
        """Errors against spacing and time of a series, results against each key of a sweep, and a page of each."""
        shape = "shape = 'ellipse'\nsemi_axes = [1, 1.2]\ncore = 2\nrings = 2"
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "scene.toml").write_text("title = 'A <drop>'\n" + SCENE.format(dimension=2, shape=shape))
            for call, pictures, words in (
                (["converge"], {"error_against_h", "error_against_time"}, ("Convergence", "error bar", "aspect")),
                (["sweep", "--set", "body.drop.material.viscosity=0.5,1", "--set", "surface_tension[0].gamma=1,2"],
                 {"against_viscosity", "against_gamma"}, ("Runs", "exit_code", "expect.aspect")),
            ):  # fmt: skip
                out = folder / call[0]
                subprocess.run(
                    [PROGRAM, call[0], folder / "scene.toml", *call[1:], "--output", out], check=True, capture_output=True
                )
                for script in ("plot", "report"):
                    done = subprocess.run(
                        ["/usr/bin/python3", "-B", ROOT / f"tools/plotting/{script}.py", out], capture_output=True, text=True
                    )
                    self.assertEqual(done.returncode, 0, done.stderr)
                sizes = {path.stem: path.stat().st_size for path in out.glob("plots/*.png")}
                self.assertEqual(set(sizes), pictures)
                self.assertGreater(min(sizes.values()), 10000)
                reader = Page()
                reader.feed((out / "report.html").read_text())
                self.assertEqual((reader.open, len(reader.sources)), ([], len(pictures)))
                for word in ("A <drop>", *words):
                    self.assertIn(word, reader.text)

    def test_a_field_on_surfaces_and_lines_of_probes(self):
        shape = "shape = 'ball'\nradius = 1\ncore = 4\nlayers = 2"
        probes = """
[[probe]]
name = "axis"
body = "drop"
from = [0, 0, -0.9]
to = [0, 0, 0.9]
points = 5
[[probe]]
name = "middle"
body = "drop"
at = [0, 0, 0]
"""
        done, pictures = self.draw(3, shape, "--field", "pressure", "--frames", "2", tables=probes)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLessEqual({"surface", "surface_pressure", "axis_line", "middle_point"}, set(pictures))
        self.assertGreater(min(pictures.values()), 10000)

    def test_vector_formats(self):
        shape = "shape = 'ellipse'\nsemi_axes = [1, 1.2]\ncore = 4\nrings = 2"
        for ending, begin in ("pdf", b"%PDF-"), ("svg", b"<?xml"):
            done, _ = self.draw(2, shape, "--format", ending)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(self.files), 4)
            for name, content in self.files.items():
                self.assertTrue(name.endswith(f".{ending}") and content.startswith(begin), name)

    def test_movie(self):
        """A movie has all frames or the requested number. All pictures differ, and the wall moves."""
        wall = """
[[contact]]
bodies = ["drop"]
contact_angle = 80
[contact.partner]
type = "half_space"
displacement = {zeros}, "-0.4*t"]
"""
        shapes = {
            2: ("shape = 'disk'\nradius = 1\ncore = 4\nrings = 2", "[0", "point = [0, -1.1]\nnormal = [0, 1]"),
            3: ("shape = 'ball'\nradius = 1\ncore = 4\nlayers = 2", "[0, 0",
                "point = [0, 0, -1.1]\nnormal = [0, 0, 1]"),
        }  # fmt: skip
        for dimension, (shape, zeros, place) in shapes.items():
            tables = wall.format(zeros=zeros) + place
            for options, count in ((), 6), (("--frames", "3"), 3):
                done, pictures = self.draw(dimension, shape, "--movie", "gif", *options, tables=tables)
                self.assertEqual((done.returncode, pictures), (0, {}), done.stderr)
                self.assertEqual(list(self.files), ["movie.gif"])
                with Image.open(io.BytesIO(self.files["movie.gif"])) as movie:
                    self.assertEqual(movie.n_frames, count)
                    self.assertEqual((movie.width % 2, movie.height % 2), (0, 0))
                    frames = []
                    for k in range(count):
                        movie.seek(k)
                        frames.append(np.array(movie.convert("RGB"), dtype=int))
                for before, after in zip(frames, frames[1:]):
                    self.assertGreater(np.abs(after - before).max(), 50)

    def test_where_a_partner_is(self):
        """Partners are drawn at the positions in the file, whatever formula moves them. Without a file, none is
        drawn."""
        wall = """
[[contact]]
name = "roof"
bodies = ["drop"]
contact_angle = 80
[contact.partner]
type = "half_space"
point = [0, 3]
normal = [0, -1]
[[contact]]
bodies = ["drop"]
contact_angle = 80
[contact.partner]
type = "half_space"
point = [0, -1.1]
normal = [0, 1]
displacement = ["0.1*sin(20*t)^2", "t < 0.03 ? -0.4*t : -0.012"]
"""
        scene = SCENE.format(dimension=2, shape="shape = 'disk'\nradius = 1\ncore = 4\nrings = 2") + wall
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "scene.toml").write_text(scene)
            subprocess.run([PROGRAM, "run", "-q", folder / "scene.toml", "--output", folder / "run"], check=True)
            run = Results(folder / "run")
            for frame, t in enumerate(run.times):
                [(_, at_rest), (partner, moved)] = partners.partners(run, frame)
                self.assertEqual((partner["type"], *at_rest), ("half_space", 0, 0))
                expected = [0.1 * math.sin(20 * t) ** 2, -0.4 * t if t < 0.03 else -0.012]
                np.testing.assert_allclose(moved, expected, atol=1e-15)
            (folder / "run/partners.h5").unlink()
            self.assertEqual(len(list(partners.partners(Results(folder / "run"), 0))), 1)

    def test_gallery(self):
        """The gallery shows the last frame of a run, named by its scene, whatever the directory is called."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            scene = ROOT / "inputs/solids/spinning_ball.toml"
            subprocess.run([PROGRAM, "run", "-q", scene, "--output", folder / "run", "--until", "1e-9"], check=False)
            call = ["/usr/bin/python3", "-B", ROOT / "tools/gallery.py", "--pictures", folder]
            done = subprocess.run([*call, folder / "run"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            with Image.open(folder / "spinning_ball.png") as picture:
                self.assertGreater(len(picture.getcolors()), 10)
            done = subprocess.run([*call, folder], capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn("gallery.py: ", done.stderr)

    def test_movie_formats(self):
        self.assertEqual(movies.file_format("gif"), "gif")
        if movies.animation.writers.is_available("ffmpeg"):
            self.assertEqual(movies.file_format("best"), "mp4")
        else:
            self.assertEqual(movies.file_format("best"), "gif")
            with self.assertRaisesRegex(ValueError, "ffmpeg, which is not installed"):
                movies.file_format("mp4")

    def test_unknown_field(self):
        shape = "shape = 'ellipse'\nsemi_axes = [1, 1.2]\ncore = 4\nrings = 2"
        done, pictures = self.draw(2, shape, "--field", "presure")
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no field 'presure'", done.stderr)
        self.assertEqual(pictures, {})


if __name__ == "__main__":
    unittest.main()
