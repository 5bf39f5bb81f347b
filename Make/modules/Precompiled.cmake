# SPDX-License-Identifier: GPL-3.0-or-later
# Headers that most sources read, compiled once a target: that is a third to a half of what a host's compiler takes for a
# short source. What a source uses it includes all the same: the CUDA backend compiles the same sources without them.
set(SHIZUKU_PRECOMPILED
    <algorithm> <array> <cmath> <filesystem> <functional> <iostream> <map> <memory> <optional> <sstream> <string>
    <unordered_map> <variant> <vector>)
