// SPDX-License-Identifier: BSD-3-Clause
// Small scenes around the examples that loads, laws and partners bring: for the list of measures,
// and for the tests of everything that is registered.
#pragma once
#include <string>

namespace meniscus {

/// A fluid ball (2D: disk) 'drop' of radius 1 about the origin, in D dimensions.
std::string one_drop(int D);
/// And an elastic one, 'other', that moves towards it, their surfaces 0.2 apart.
std::string two_drops(int D);
/// A hollow elastic 'shell' of outer radius 2 (3D).
std::string one_shell();
/// A ball (2D: disk) of radius 1 without a material.
std::string example_ball(int D, const std::string& name);
/// The material of 'other'.
std::string example_solid();
/// The material of 'drop'.
std::string example_liquid();
/// A nematic, as a table of its own after the other lines of a body.
std::string example_nematic(int D);

/// The lines of a scene before its bodies; `time` are more of [time].
std::string example_heading(int D, const std::string& time = "");
/// The scene with the bodies that the lines of a load name, and the load [[name]].
std::string scene_with_load(int D, const std::string& name, const std::string& lines);
/// The lines of a contact of 'drop' by interaction "legacy_switch", which brings no example: it
/// goes with a plane and this tension only.
std::string legacy_contact(int D);

}  // namespace meniscus
