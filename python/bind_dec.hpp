// Names of what temper dec writes.
#pragma once

#include "convert.hpp"
#include "temper/dec_io.hpp"

TEMPER_PYTHON_NAMES(temper::io::DecFormat, "npz", "mtx", "vtu", "disv", "disu", "tough");
