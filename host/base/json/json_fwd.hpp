// JSON by name, for headers that only pass it on.
#pragma once

namespace liana {

class Json;

}  // namespace liana
