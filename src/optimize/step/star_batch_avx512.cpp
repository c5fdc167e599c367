#include "optimize/step/star_batch_set.hpp"
