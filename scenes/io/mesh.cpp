#include "scenes/core/scene.h"
