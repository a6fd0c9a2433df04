// A plugin of another time: its descriptor carries a number of the plugin interface that this
// program does not have.
#include "core/plugin/plugin.h"

PSSMLT_EXPORT const pssmlt::PluginDescriptor pssmlt_plugin_descriptor;
const pssmlt::PluginDescriptor pssmlt_plugin_descriptor = {999, __VERSION__, "Material", "stale"};
