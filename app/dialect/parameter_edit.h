// Changing the parameters of a directive that has been read.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/scene/parameters.h"

namespace pssmlt::v3 {

Parameter* find(ParameterSet& set, std::string_view name);
bool has(const ParameterSet& set, std::string_view name);
// Removes and returns it; nullopt if it is not there.
std::optional<Parameter> take(ParameterSet& set, std::string_view name);
void rename(ParameterSet& set, std::string_view from, std::string_view to);
// Replaces a parameter of the same name.
void put(ParameterSet& set, Parameter parameter);

// New parameters, located where what they come from stands.
Parameter number(std::string name, float value, const Location& where);
Parameter integer(std::string name, int value, const Location& where);
Parameter flag(std::string name, bool value, const Location& where);
Parameter text(std::string name, std::vector<std::string> values, const Location& where);
Parameter colour(std::string name, const Rgb& value, const Location& where);
Parameter texture(std::string name, std::string texture, const Location& where);
Parameter renamed(Parameter parameter, std::string name);

// Removes a parameter with one value and returns that; throws Error on another type or number.
float take_number(ParameterSet& set, std::string_view name, float fallback);
int take_integer(ParameterSet& set, std::string_view name, int fallback);
bool take_flag(ParameterSet& set, std::string_view name, bool fallback);
std::string take_text(ParameterSet& set, std::string_view name, const std::string& fallback);

// A constant as a colour or number: of rgb and float parameters, nullopt of textures and spectra.
std::optional<Rgb> constant(const Parameter& p);
std::optional<float> constant_luminance(const Parameter& p);

}  // namespace pssmlt::v3
