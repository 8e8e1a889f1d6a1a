// SPDX-License-Identifier: BSD-3-Clause
// Small scenes around the examples that loads, laws and partners provide. The list of measures and
// the tests of all registered items use them.
#pragma once
#include <string>

namespace meniscus {

/// The lines of a scene with a fluid ball (2D: disk) 'drop' of radius 1 about the origin.
std::string one_drop(int D);
/// Like one_drop(), with an elastic ball 'other' that moves towards the drop; their surfaces are
/// 0.2 apart.
std::string two_drops(int D);
/// Half a fluid ball (2D: disk) 'drop' on its face 'flat', with surface tension. `lines` are
/// further keys of the body.
std::string sessile_drop(int D, const std::string& lines = "");
/// A hollow elastic 'shell' of outer radius 2 (3D).
std::string one_shell();
/// A ball (2D: disk) of radius 1 without a material.
std::string example_ball(int D, const std::string& name);
/// The material of 'other'.
std::string example_solid();
/// The material of 'drop'.
std::string example_liquid();
/// The director of a nematic, as a table that follows the other lines of a body.
std::string example_nematic(int D);

/// The lines of a scene before its bodies. `time` has further lines of [time].
std::string example_heading(int D, const std::string& time = "");
/// The lines of the scene of a body of revolution before its body.
std::string revolved_heading(const std::string& time = "");
/// A scene with the load [[name]], given by `lines`, and the bodies that these lines refer to.
std::string scene_with_load(int D, const std::string& name, const std::string& lines);
/// The lines of a contact of 'drop' by the interaction "legacy_switch". This interaction has no
/// example, since it needs a plane and this surface tension.
std::string legacy_contact(int D);

}  // namespace meniscus
