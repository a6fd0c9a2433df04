"""All tests of this folder in one browser."""
import sys
import unittest

import support

support.start()
try:
    names = ["test_page", "test_pictures", "test_moving", "test_live"]
    main = unittest.main(module=None, argv=sys.argv[:1] + (sys.argv[1:] or ["-v"] + names),
                         exit=False)
finally:
    support.stop()
sys.exit(0 if main.result.wasSuccessful() else 1)
