#include "optimize/batch/star_batch_set.hpp"
