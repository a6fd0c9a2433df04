// Nothing: what is precompiled for others needs a source file of its own.
