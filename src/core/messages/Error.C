#include "core/messages/Error.H"
