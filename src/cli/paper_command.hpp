// SPDX-License-Identifier: MIT
#pragma once

namespace abbe::cli {

/// `abbe study --paper`: no scene of the user's.
int run_paper(int argc, char** argv);

} // namespace abbe::cli
