// SPDX-License-Identifier: BSD-3-Clause
// The examples of the loads of the program.
#include "load_examples.hpp"

#include <fmt/core.h>

namespace meniscus::test {

std::string LoadExample::scene(int D) const {
  return fmt::format("dimension = {}\n[time]\nend = 1e3\ncheck_every = 20\n{}{}", D, bodies(D),
                     tables(D));
}

std::string one_drop(int D) {
  return fmt::format(R"toml([[body]]
name = "drop"
shape = "{}"
radius = 1
{}
material = {{ type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }}
)toml",
                     D == 3 ? "ball" : "disk",
                     D == 3 ? "core = 3\nlayers = 2" : "core = 6\nrings = 3");
}

std::string two_drops(int D) {
  return one_drop(D) + fmt::format(R"toml([[body]]
name = "other"
shape = "{}"
radius = 1
{}
centre = [2.2, 0{}]
initial_velocity = ["-0.3", 0{}]
material = {{ type = "neo_hookean", density = 1, mu = 3, lambda = 10 }}
)toml",
                                   D == 3 ? "ball" : "disk",
                                   D == 3 ? "core = 3\nlayers = 2" : "core = 6\nrings = 3",
                                   D == 3 ? ", 0" : "", D == 3 ? ", 0" : "");
}

std::string one_shell(int) {
  return R"toml([[body]]
name = "shell"
shape = "disk_shell"
radius = 2
height = 1.6
thickness = 0.4
spacing = 0.6
material = { type = "neo_hookean", density = 1, mu = 1, lambda = 5 }
)toml";
}

namespace {

std::string contact(const std::string& bodies, const std::string& more) {
  return "[[contact]]\nbodies = " + bodies + "\nepsilon = 1\nsigma0 = 0.3\nbeta = 1\nskin = 10\n" +
         more;
}

std::string tension(const std::string& form) {
  return "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\nform = \"" + form + "\"\n";
}

const bool registered =
    register_entry(LoadExample{
        "surface_tension.balanced", one_drop,
        [](int) { return tension("balanced") + "coefficient_damping = 0\n"; }, true, true}) &&
    register_entry(LoadExample{"surface_tension.damped", one_drop,
                               [](int) { return tension("balanced"); }, false, false}) &&
    register_entry(LoadExample{"surface_tension.weak", one_drop,
                               [](int) { return tension("weak"); }, true, true}) &&
    register_entry(LoadExample{"surface_tension.curvature", one_drop,
                               [](int) { return tension("curvature"); }, false, false}) &&
    register_entry(LoadExample{"surface_tension.triangles", one_drop,
                               [](int) { return tension("triangles"); }, true, true}) &&
    register_entry(LoadExample{"surface.tension", one_drop,
                               [](int) -> std::string {
                                 return "[[surface]]\nbody = \"drop\"\n"
                                        "law = { type = \"tension\", gamma = 1 }\n";
                               },
                               true, true}) &&
    register_entry(LoadExample{"cavity.pressure", one_drop,
                               [](int) -> std::string {
                                 return "[[cavity]]\nbody = \"drop\"\nsurface = \"outer\"\n"
                                        "pressure = 0.3\n";
                               },
                               true, true}) &&
    register_entry(LoadExample{"cavity.content", one_drop,
                               [](int) -> std::string {
                                 return "[[cavity]]\nbody = \"drop\"\nsurface = \"outer\"\n"
                                        "volume_target = 0.9\npenalty = 2\nramp = [0, 0.2]\n";
                               },
                               true, true}) &&
    register_entry(LoadExample{"profile", one_shell,
                               [](int D) -> std::string {
                                 return D == 2 ? ""
                                               : "[[profile]]\nbody = \"shell\"\nr = [0, 2]\n"
                                                 "z = [0.8, 0]\n";
                               },
                               false, false}) &&
    register_entry(LoadExample{"body_force", one_drop,
                               [](int D) -> std::string {
                                 return std::string(
                                            "[[body_force]]\nbody = \"drop\"\n"
                                            "acceleration = [\"0.1*x*cos(t)\", -1") +
                                        (D == 3 ? ", 0]\n" : "]\n");
                               },
                               false, false}) &&
    register_entry(LoadExample{"exact", one_drop,
                               [](int D) -> std::string {
                                 const std::string zeros = D == 3 ? "[0, 0, 0]\n" : "[0, 0]\n";
                                 return "[[exact]]\nbody = \"drop\"\ndisplacement = " + zeros +
                                        "velocity = " + zeros + "rate = 1\n";
                               },
                               false, false}) &&
    register_entry(LoadExample{"contact.pair", two_drops,
                               [](int) { return contact("[\"drop\", \"other\"]", ""); }, true,
                               true}) &&
    register_entry(LoadExample{
        "contact.volume", two_drops,
        [](int) { return contact("[\"drop\", \"other\"]", "form = \"volume\"\n"); }, true, true}) &&
    register_entry(LoadExample{"contact.plate", one_drop,
                               [](int D) {
                                 return contact("[\"drop\"]",
                                                std::string("partner = { type = \"half_space\", ") +
                                                    (D == 3 ? "point = [0, 0, -1.3], "
                                                              "normal = [0, 0, 1] }\n"
                                                            : "point = [0, -1.3], "
                                                              "normal = [0, 1] }\n"));
                               },
                               true, false});

}  // namespace
}  // namespace meniscus::test
