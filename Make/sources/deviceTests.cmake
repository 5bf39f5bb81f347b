# Tests that run on a device, once per backend. Paths below tests/unit/.
set(SHIZUKU_DEVICE_TESTS
)
