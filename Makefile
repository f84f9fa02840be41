# The front door. Meson does the building: `meson setup build && ninja -C build` is the same.

BUILD ?= build
MESON_OPTIONS ?=
PREFIX ?= /usr/local
RENDER_OPTIONS ?= --technique cone --resolution 1200,750 --samples 3 --environment 0.9,1.1,1.4
JOBS := $(shell nproc)

.PHONY: all
all: $(BUILD)/build.ninja  ## build the command and the library
	@ninja -C $(BUILD)
	@echo "Built $(BUILD)/lightsheaf and $(BUILD)/src/liblightsheaf.so"

.PHONY: help
help:  ## list these targets
	@sed -n 's/^\([a-z]*\):.*## /make \1\t/p' $(firstword $(MAKEFILE_LIST)) | expand -t 16

$(BUILD)/build.ninja:
	meson setup $(BUILD) --prefix $(PREFIX) $(MESON_OPTIONS)

.PHONY: packages
packages:  ## install the Debian packages of packages.txt that are missing, but those of tests
	@scripts/install-packages $(BUILD)

.PHONY: test-packages
test-packages:
	@scripts/install-packages $(BUILD) tests

.PHONY: render
render: packages  ## install what is missing, build, render the furnished interior to render.png
	@$(MAKE) --no-print-directory $(BUILD)/build.ninja
	@ninja -C $(BUILD) command
	$(BUILD)/lightsheaf render data/scenes/interior.gltf -o render.png $(RENDER_OPTIONS)
	@echo "The picture is in $(CURDIR)/render.png"

.PHONY: test
test: test-packages  ## install what is missing, build, run every test
	@$(MAKE) --no-print-directory all
	@meson test -C $(BUILD) --no-rebuild --print-errorlogs --num-processes $(JOBS) \
	    --wrapper '"$(CURDIR)/scripts/run-test"' $(TEST_OPTIONS); \
	    scripts/test-report $(BUILD)

.PHONY: sanitize
sanitize:  ## the tests once more, under AddressSanitizer and UndefinedBehaviorSanitizer
	@mkdir -p $(BUILD)/tests # for its shader cache, which both share: to compile takes a minute
	@$(MAKE) --no-print-directory test BUILD=$(BUILD)-sanitize TEST_OPTIONS='--timeout-multiplier 6' \
	    MESON_OPTIONS='$(MESON_OPTIONS) -Dbuildtype=debugoptimized \
	    -Db_sanitize=address,undefined -Db_lundef=false \
	    -Dtest_shader_cache=$(abspath $(BUILD))/tests/shader-cache'

.PHONY: figures
figures: all  ## measure the tables of the pages anew, which takes two hours of an idle machine
	scripts/figures --build $(BUILD) $(FIGURES)

.PHONY: install
install: all  ## install to PREFIX (/usr/local), below DESTDIR
	@meson install -C $(BUILD) --no-rebuild

.PHONY: format
format:  ## apply .clang-format to every C and C++ file
	git ls-files '*.c' '*.h' '*.cpp' '*.hpp' | xargs clang-format -i

.PHONY: clean
clean:  ## remove what was built
	rm -rf $(BUILD) $(BUILD)-sanitize render.png
